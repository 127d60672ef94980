#pragma once

#include <atomic>
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

/// Returns the folder "references" in user_cache_folder().
std::filesystem::path default_reference_cache();

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
  /// Receives messages on files that were damaged.
  std::function<void(const std::string&)> warn;
  /// Ends the wait for another process that makes the same reference. May be null.
  const std::atomic<bool>* stop = nullptr;
};

/// Returns the reference of a plan. It is read from its file or from `cache`, or those parts are
/// made that are missing. If the work is stopped, finished parts stay in the cache and the result
/// is empty. Damaged files of the cache are moved aside and made again. Throws what
/// PartControl::make() throws.
std::optional<Reference> find_or_render(const PlannedReference& planned,
                                        const std::filesystem::path& cache,
                                        const Registry& registry, const PartControl& control);

}  // namespace pharos
