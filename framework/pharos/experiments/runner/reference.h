#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include <pharos/core/image.h>
#include <pharos/experiments/runner/plan.h>
#include <pharos/rendering/render_job.h>

namespace pharos {

/// What errors are measured against, and where it comes from.
struct Reference {
  Image image;                 ///< R, G, B
  std::string key;             ///< of its content
  std::filesystem::path file;  ///< given, or in the cache
  // Of rendered references only; 0 or empty for files that others made.
  double samples_per_pixel = 0;
  double seconds = 0;
  std::string version;  ///< of Pharos
  std::string build;    ///< see build_key(): the code that rendered it
  /// Its own expected error, from two halves of its parts: results as small as this mean nothing.
  std::optional<double> mse, relative_mse;
};

/// The folder for references in the user's cache, see user_cache_folder(): references.
std::filesystem::path default_reference_cache();

/// Called before each part of a reference is rendered.
using PartReport = std::function<void(std::uint32_t part, std::uint32_t parts)>;

/// The reference of a plan: from its file or from `cache`, or rendered as far as it is not there
/// yet; parts that are finished stay in the cache when it is stopped. Empty when it was stopped.
/// Throws InputError for a file of the cache that is damaged.
std::optional<Reference> find_or_render(const PlannedReference& planned,
                                        const std::filesystem::path& cache,
                                        const Registry& registry, const RenderControl& control,
                                        const PartReport& report);

}  // namespace pharos
