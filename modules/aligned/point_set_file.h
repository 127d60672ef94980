#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "point_set.h"

/// Files of point sets. The binary form holds any number of sets of the same size; numbers are
/// little-endian:
///
///     line      "pharos point_sets 1"
///     uint64    key: what the sets are, for whoever wrote them
///     uint32    number of sets
///     uint32    points of each
///     uint64    checksum: XXH3 (64 bits) of the last set, its seed that of the set before, and so
///     on uint16    x, y of each point, one set after the other: GridPoint
namespace pharos::aligned {

/// What a file holds.
struct StoredSets {
  std::uint64_t key = 0;
  std::vector<PointSet> sets;  ///< all of one size
};

/// Writes the binary form.
void save_point_sets(std::ostream& out, const StoredSets& stored);
/// Reads it, to the end of `in`. Throws InputError, which is not located, for anything else,
/// damaged and cut off files included.
StoredSets load_point_sets(std::istream& in);

/// Writes a file of the binary form, whole or not at all. Throws RunError.
void write_point_sets(const std::filesystem::path& file, const StoredSets& stored);
/// Writes the points as text, "x y" a line, exact; whole or not at all. Throws RunError.
void write_point_list(const std::filesystem::path& file, const PointSet& points);

}  // namespace pharos::aligned
