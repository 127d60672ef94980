#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "point_set.h"

/// Files of point sets. The binary form holds any number of sets of the same size. Numbers are
/// little-endian:
///
///     line      "pharos point_sets 1"
///     uint64    key: identifies the sets for the writer of the file
///     uint32    number of sets
///     uint32    number of points per set
///     uint64    checksum: XXH3 (64 bits) of the last set, with the checksum of the previous set
///               as seed, and so on for all previous sets
///     uint16    x, y of each point, one set after the other: GridPoint
namespace pharos::aligned {

/// The content of a file.
struct StoredSets {
  std::uint64_t key = 0;
  std::vector<PointSet> sets;  ///< all sets have the same size
};

/// Writes the binary form.
void save_point_sets(std::ostream& out, const StoredSets& stored);
/// Reads the binary form up to the end of `in`. Throws InputError without a location for any other
/// content, including damaged and truncated files.
StoredSets load_point_sets(std::istream& in);

/// Writes a file of the binary form, completely or not at all. Throws RunError.
void write_point_sets(const std::filesystem::path& file, const StoredSets& stored);
/// Writes the points as text, one line "x y" per point, with exact numbers; completely or not at
/// all. Throws RunError.
void write_point_list(const std::filesystem::path& file, const PointSet& points);

}  // namespace pharos::aligned
