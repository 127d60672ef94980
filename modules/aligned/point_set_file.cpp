#include "point_set_file.h"

#include <fstream>
#include <istream>
#include <ostream>
#include <xxhash.h>

#include <fmt/format.h>

#include <pharos/core/atomic_file.h>
#include <pharos/core/binary_stream.h>
#include <pharos/core/error.h>

#include "synthesis.h"

namespace pharos::aligned {
namespace {

constexpr const char* kForm = "point_sets";
constexpr std::uint32_t kVersion = 1;
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

}  // namespace

void save_point_sets(std::ostream& out, const StoredSets& stored) {
  const std::size_t points = stored.sets.empty() ? 0 : stored.sets.front().size();
  save_heading(out, kForm, kVersion);
  save_number(out, stored.key);
  save_number(out, static_cast<std::uint32_t>(stored.sets.size()));
  save_number(out, static_cast<std::uint32_t>(points));
  save_number(out, checksum(stored.sets));
  for (const PointSet& set : stored.sets) {
    out.write(reinterpret_cast<const char*>(set.data()),
              static_cast<std::streamsize>(set.size() * sizeof(GridPoint)));
  }
}

StoredSets load_point_sets(std::istream& in) {
  expect_heading(in, kForm, kVersion);
  StoredSets stored;
  stored.key = load_number<std::uint64_t>(in);
  const auto sets = load_number<std::uint32_t>(in), points = load_number<std::uint32_t>(in);
  const auto expected = load_number<std::uint64_t>(in);
  if (sets > kMostSets || points > kMostPoints) throw InputError("what was saved is damaged");
  for (std::uint32_t i = 0; i < sets; ++i) stored.sets.push_back(load_set(in, points));
  const bool ends = in.peek() == std::istream::traits_type::eof();
  if (!ends || checksum(stored.sets) != expected) throw InputError("what was saved is damaged");
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
