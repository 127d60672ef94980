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

/// Returns the folder "references" in user_cache_folder().
std::filesystem::path default_reference_cache();

/// Called before each part of a reference is rendered.
using PartReport = std::function<void(std::uint32_t part, std::uint32_t parts)>;
/// Receives messages on files that were damaged.
using Tell = std::function<void(const std::string&)>;

/// Returns the reference of a plan. It is read from its file or from `cache`, or those parts are
/// rendered that are missing. If the work is stopped, finished parts stay in the cache and the
/// result is empty. Damaged files of the cache are moved aside and rendered again.
std::optional<Reference> find_or_render(const PlannedReference& planned,
                                        const std::filesystem::path& cache,
                                        const Registry& registry, const RenderControl& control,
                                        const PartReport& report, const Tell& tell);

}  // namespace pharos
