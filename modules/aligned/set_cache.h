#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "point_set.h"
#include "synthesis.h"

namespace pharos::aligned {

/// Returns the folder for point sets in the user's cache (see user_cache_folder()): aligned-sets.
std::filesystem::path default_set_folder();

/// Stores synthesized sets in a folder, with one file per set. All settings that determine the
/// points form the name of the file, and a checksum protects its content. Losing files or the
/// folder costs time but changes no result. Safe for concurrent use by several threads and
/// processes.
class SetCache {
 public:
  /// The folder is created when the first set is stored.
  explicit SetCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Returns the set of these settings. The result is empty if the file does not exist or is
  /// damaged; a damaged file causes a warning.
  std::optional<PointSet> find(const SynthesisSettings& settings) const;
  /// Stores a set. Logs a warning if the set cannot be written.
  void keep(const SynthesisSettings& settings, const PointSet& set) const;

  /// Returns the path of the file for these settings.
  std::filesystem::path file(const SynthesisSettings& settings) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace pharos::aligned
