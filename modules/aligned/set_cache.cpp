#include "set_cache.h"

#include <fstream>
#include <mutex>
#include <string>
#include <system_error>
#include <xxhash.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <pharos/core/error.h>
#include <pharos/core/log.h>
#include <pharos/core/user_cache.h>

#include "point_set_file.h"

namespace pharos::aligned {
namespace {

namespace fs = std::filesystem;

/// The version must increase whenever synthesize() makes other points from the same settings.
constexpr int kSynthesisVersion = 4;

/// Returns a text with all settings that determine the points.
std::string text_of(const SynthesisSettings& s) {
  const SuppressionRule& r = s.rule;
  std::string text = fmt::format("{} | {} | {} | {} {} | {} {} | {} | {} {} {} {} {} {}",
                                 kSynthesisVersion, s.points, fmt::join(s.directions, " "), s.steps,
                                 s.step, s.spectrum, s.wasserstein, s.seed, r.radius, r.exact,
                                 r.half_angle, r.edge_length, r.anywhere, r.share);
  for (const TargetPower& v : s.mask) {
    text += fmt::format(" | {} {} {} {}", v.x, v.y, v.power, v.weight);
  }
  return text;
}

std::uint64_t key_of(const SynthesisSettings& settings) {
  const std::string text = text_of(settings);
  return XXH3_64bits(text.data(), text.size());
}

/// Reads the set of these settings. Throws InputError if the file holds anything else.
PointSet read_set(const fs::path& file, const SynthesisSettings& settings) {
  if (const std::string problem = file_problem(file); !problem.empty()) throw InputError(problem);
  std::ifstream in(file, std::ios::binary);
  StoredSets stored = load_point_sets(in);
  const bool is_this = stored.key == key_of(settings) && stored.sets.size() == 1 &&
                       stored.sets.front().size() == settings.points;
  if (!is_this) throw InputError("it holds another set");
  return std::move(stored.sets.front());
}

}  // namespace

fs::path default_set_folder() {
  return user_cache_folder() / "aligned-sets";
}

fs::path SetCache::file(const SynthesisSettings& settings) const {
  return folder_ / fmt::format("{}-{}-{:016x}.bin", settings.points,
                               fmt::join(settings.directions, "-"), key_of(settings));
}

std::optional<PointSet> SetCache::find(const SynthesisSettings& settings) const {
  const fs::path path = file(settings);
  std::error_code failed;
  if (!fs::exists(path, failed)) return std::nullopt;
  try {
    return read_set(path, settings);
  } catch (const InputError& error) {
    log_warning(fmt::format("the point set '{}' is made again: {}", path.string(), error.what()));
    return std::nullopt;
  }
}

void SetCache::keep(const SynthesisSettings& settings, const PointSet& set) const {
  // Without the lock, several threads of a process would write the same temporary file.
  static std::mutex writing;
  const std::scoped_lock lock(writing);
  const fs::path path = file(settings);
  std::error_code failed;
  fs::create_directories(folder_, failed);
  try {
    write_point_sets(path, {.key = key_of(settings), .sets = {set}});
  } catch (const RunError& error) {
    log_warning(fmt::format("the point set '{}' is not kept: {}", path.string(), error.what()));
  }
}

}  // namespace pharos::aligned
