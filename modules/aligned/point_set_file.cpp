#include "point_set_file.h"

#include <fstream>
#include <istream>
#include <ostream>
#include <xxhash.h>

#include <fmt/format.h>

#include <pharos/core/archive.h>
#include <pharos/core/atomic_file.h>
#include <pharos/core/error.h>

#include "synthesis.h"

namespace pharos::aligned {
namespace {

/// More than there are in any library: a damaged number must not become memory.
constexpr std::uint32_t kMostSets = 1u << 14;

static_assert(sizeof(GridPoint) == 4, "sets are written as they lie in memory");

std::uint64_t checksum(std::uint64_t seed, const PointSet& set) {
  return XXH3_64bits_withSeed(set.data(), set.size() * sizeof(GridPoint), seed);
}

std::uint64_t checksum(const std::vector<PointSet>& sets) {
  std::uint64_t sum = 0;
  for (const PointSet& set : sets) sum = checksum(sum, set);
  return sum;
}

PointSet load_set(std::istream& in, std::uint32_t points) {
  PointSet set(points);
  in.read(reinterpret_cast<char*>(set.data()),
          static_cast<std::streamsize>(points * sizeof(GridPoint)));
  if (!in) throw InputError("what was saved is cut off");
  return set;
}

/// The header of the file, before the points.
struct Head {
  std::uint64_t key = 0;
  std::uint32_t sets = 0, points = 0;
  std::uint64_t checksum = 0;

  void archive(Archive& archive) {
    archive.heading("point_sets", 1);
    archive(key, sets, points, checksum);
  }
};

}  // namespace

void save_point_sets(std::ostream& out, const StoredSets& stored) {
  const std::size_t points = stored.sets.empty() ? 0 : stored.sets.front().size();
  Head head{stored.key, static_cast<std::uint32_t>(stored.sets.size()),
            static_cast<std::uint32_t>(points), checksum(stored.sets)};
  save(out, head);
  for (const PointSet& set : stored.sets) {
    out.write(reinterpret_cast<const char*>(set.data()),
              static_cast<std::streamsize>(set.size() * sizeof(GridPoint)));
  }
}

StoredSets load_point_sets(std::istream& in) {
  Head head;
  load(in, head);
  if (head.sets > kMostSets || head.points > kMostPoints) {
    throw InputError("what was saved is damaged");
  }
  StoredSets stored{.key = head.key};
  for (std::uint32_t i = 0; i < head.sets; ++i) stored.sets.push_back(load_set(in, head.points));
  const bool ends = in.peek() == std::istream::traits_type::eof();
  if (!ends || checksum(stored.sets) != head.checksum) {
    throw InputError("what was saved is damaged");
  }
  return stored;
}

void write_point_sets(const std::filesystem::path& file, const StoredSets& stored) {
  write_atomically(file, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    save_point_sets(out, stored);
    out.flush();
    if (!out) throw RunError(fmt::format("cannot write '{}'", file.string()));
  });
}

void write_point_list(const std::filesystem::path& file, const PointSet& points) {
  std::string text;
  for (const Vec2 p : positions(points)) text += fmt::format("{} {}\n", p.x, p.y);
  write_text_atomically(file, text);
}

}  // namespace pharos::aligned
