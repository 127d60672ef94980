#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include <pharos/core/image.h>
#include <pharos/experiments/runner/plan.h>
#include <pharos/rendering/render_job.h>

namespace pharos {

/// The image that errors are measured against, and its origin.
struct Reference {
  Image image;                 ///< R, G, B
  std::string key;             ///< key of its content
  std::filesystem::path file;  ///< the given file, or the file in the cache
  // For rendered references only; 0 or empty for files that others made.
  double samples_per_pixel = 0;
  double seconds = 0;
  std::string version;  ///< version of Pharos that rendered it
  std::string build;    ///< key of the code that rendered it, see build_key()
  /// The reference's own expected error, from two halves of its parts. Measured errors as small as
  /// this mean nothing.
  std::optional<double> mse, relative_mse;
};

/// Returns the folder where processes claim the parts of references, and the name of a claim.
std::filesystem::path reference_claims(const std::filesystem::path& cache);
std::string part_claim(const PlannedReference& planned, std::uint32_t part);

/// Receives messages on files that were damaged.
using Warn = std::function<void(const std::string&)>;

/// Everything that one part of a reference needs. A process of its own can render it.
struct PartOrder {
  std::string config;          ///< resolved config with its seed, as YAML
  std::string build;           ///< build_key() of the code that shall render it
  std::filesystem::path file;  ///< where the image is written
};

/// Renders a part of a reference into its file. Returns false if it was stopped. Throws RunError if
/// this program has other code than the order asks for.
bool make_part(const PartOrder& order, const Registry& registry, const RenderControl& control);

/// Callbacks that make the parts of a reference and receive messages.
struct PartControl {
  /// Makes a part as make_part() does.
  std::function<bool(const PartOrder&)> make;
  /// Called before each part is made.
  std::function<void(std::uint32_t part, std::uint32_t parts)> report;
  Warn warn;
};

struct ReferenceSearch {
  std::optional<Reference> reference;
  /// Whether PartControl::make() was stopped. If there is no reference nevertheless, other
  /// processes make what is missing.
  bool is_stopped = false;
};

/// Returns the reference of a plan from its file or from `cache`; none if it must be rendered
/// first. Damaged files of the cache are moved aside.
std::optional<Reference> known_reference(const PlannedReference& planned,
                                         const std::filesystem::path& cache, const Warn& warn);

/// Returns the reference of a plan. It is read from its file or from `cache`, or those parts are
/// made that are missing and that no other process makes. If the work is stopped, finished parts
/// stay in the cache. Damaged files of the cache are moved aside and made again. Throws what
/// PartControl::make() throws.
ReferenceSearch find_or_render(const PlannedReference& planned, const std::filesystem::path& cache,
                               const Registry& registry, const PartControl& control);

}  // namespace pharos
