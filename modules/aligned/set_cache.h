#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "point_set.h"
#include "synthesis.h"

namespace pharos::aligned {

/// The folder for point sets in the user's cache, see user_cache_folder(): aligned-sets.
std::filesystem::path default_set_folder();

/// Synthesized sets in a folder, a file each, named by all settings that determine the points and
/// guarded by a checksum. Losing files, or the folder, costs time and changes nothing. Safe to be
/// used by several threads and processes at once.
class SetCache {
 public:
  /// The folder is made when the first set is kept.
  explicit SetCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The set of these settings; none where there is no file, or a damaged one, which is warned of.
  std::optional<PointSet> find(const SynthesisSettings& settings) const;
  /// Keeps a set. Where it cannot be written that is warned of.
  void keep(const SynthesisSettings& settings, const PointSet& set) const;

  /// The file of these settings.
  std::filesystem::path file(const SynthesisSettings& settings) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace pharos::aligned
