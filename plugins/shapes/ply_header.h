#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// The header of a PLY file (Turk 1994, "The PLY Polygon File Format").
namespace pharos {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
/// Returns the size of a number [bytes].
std::size_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  std::optional<PlyType> count_type;  ///< lists only: the type of the number before the items
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

enum class PlyFormat { ascii, little_endian, big_endian };

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
  std::size_t size = 0;  ///< [bytes] from the file's beginning to the data
};

/// Reads the header at the beginning of `text`, a whole file. Throws InputError, without the file's
/// name, if there is no valid header.
PlyHeader read_ply_header(std::string_view text);

}  // namespace pharos
