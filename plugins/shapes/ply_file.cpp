#include "ply_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <utility>

#include <fmt/core.h>

#include <pharos/core/error.h>

#include "decimal.h"
#include "ply_header.h"
#include "triangle_shape.h"

namespace pharos {
namespace {

static_assert(std::endian::native == std::endian::little);

/// Returns the numbers after the header one by one.
class Numbers {
 public:
  Numbers(std::string_view data, PlyFormat format)
      : at_(data.data()), end_(data.data() + data.size()), format_(format) {}

  /// [bytes]; every number takes at least one byte.
  std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }

  /// Returns false if the data ends or does not contain a number.
  bool next(PlyType type, double& value) {
    return format_ == PlyFormat::ascii ? next_word(value) : next_binary(type, value);
  }

 private:
  bool next_word(double& value) {
    while (at_ < end_ && static_cast<unsigned char>(*at_) <= ' ') ++at_;
    const auto [rest, error] = read_decimal(at_, end_, value);
    const bool ends_there = rest == end_ || static_cast<unsigned char>(*rest) <= ' ';
    at_ = rest;
    return error == std::errc{} && ends_there;
  }

  bool next_binary(PlyType type, double& value) {
    if (left() < size_of(type)) return false;
    value = binary(type);
    at_ += size_of(type);
    return true;
  }

  double binary(PlyType type) const {
    switch (type) {
      case PlyType::int8:
        return bytes_as<std::int8_t>();
      case PlyType::uint8:
        return bytes_as<std::uint8_t>();
      case PlyType::int16:
        return bytes_as<std::int16_t>();
      case PlyType::uint16:
        return bytes_as<std::uint16_t>();
      case PlyType::int32:
        return bytes_as<std::int32_t>();
      case PlyType::uint32:
        return bytes_as<std::uint32_t>();
      case PlyType::float32:
        return bytes_as<float>();
      case PlyType::float64:
        break;
    }
    return bytes_as<double>();
  }

  template <class T>
  T bytes_as() const {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), at_, sizeof(T));
    if (format_ == PlyFormat::big_endian) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<T>(bytes);
  }

  const char* at_;
  const char* end_;
  PlyFormat format_;
};

/// The columns of vertex data that are used.
enum Column { kX, kNormalX = 3, kU = 6, kColumns = 8, kOther = kColumns };

int column_of(std::string name) {
  static constexpr std::array<std::string_view, kColumns> names{"x",  "y",  "z", "nx",
                                                                "ny", "nz", "u", "v"};
  if (name.starts_with("texture_")) name.erase(0, 8);
  if (name == "s") name = "u";
  if (name == "t") name = "v";
  return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
}

class PlyReader {
 public:
  explicit PlyReader(std::string_view text)
      : header_(read_ply_header(text)), numbers_(text.substr(header_.size), header_.format) {}

  TriangleMesh read() {
    for (const PlyElement& element : header_.elements) {
      check_room(element);
      read_rows(element);
    }
    check_indices();
    return std::move(mesh_);
  }

 private:
  /// Throws InputError if the rest of the data is too short. Every property takes at least one
  /// byte.
  void check_room(const PlyElement& element) const {
    const std::uint64_t properties = element.properties.size();
    if (properties == 0 || element.count <= numbers_.left() / properties) return;
    throw InputError(fmt::format("it ends before its {} elements '{}'", element.count,
                                 one_line(element.name, 40)));
  }

  void read_rows(const PlyElement& element) {
    if (element.name == "vertex") find_columns(element);
    if (element.properties.empty()) return;  // its rows take no bytes, for any count
    for (row_ = 0; row_ < element.count; ++row_) {
      if (element.name == "vertex") {
        read_vertex(element);
      } else if (element.name == "face") {
        read_face(element);
      } else {
        for (const PlyProperty& property : element.properties) pass_over(element, property);
      }
    }
  }

  [[noreturn]] void fail(const PlyElement& element, const std::string& what) const {
    throw InputError(fmt::format("{} {} {}", one_line(element.name, 40), row_, what));
  }

  double number(const PlyElement& element, PlyType type) {
    double value = 0;
    if (!numbers_.next(type, value)) fail(element, "is cut off or not made of numbers");
    return value;
  }

  std::uint64_t list_size(const PlyElement& element, const PlyProperty& property) {
    const double size = number(element, *property.count_type);
    if (!(size >= 0 && size <= static_cast<double>(numbers_.left()))) {
      fail(element, "has a list that is longer than the file");
    }
    return static_cast<std::uint64_t>(size);
  }

  void pass_over(const PlyElement& element, const PlyProperty& property) {
    const std::uint64_t count = property.count_type ? list_size(element, property) : 1;
    for (std::uint64_t i = 0; i < count; ++i) number(element, property.type);
  }

  void find_columns(const PlyElement& element) {
    std::array<bool, kColumns + 1> present{};
    columns_.clear();
    for (const PlyProperty& property : element.properties) {
      columns_.push_back(property.count_type ? int{kOther} : column_of(property.name));
      present[static_cast<std::size_t>(columns_.back())] = true;
    }
    const auto all = [&](int first, int end) {
      return std::all_of(&present[0] + first, &present[0] + end, [](bool b) { return b; });
    };
    if (!all(kX, kNormalX)) throw InputError("its vertices lack x, y or z");
    has_normals_ = all(kNormalX, kU);
    has_uvs_ = all(kU, kColumns);
    mesh_.positions.reserve(element.count);
  }

  void read_vertex(const PlyElement& element) {
    std::array<float, kColumns> v{};
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (columns_[i] == kOther) {
        pass_over(element, element.properties[i]);
      } else {
        v[static_cast<std::size_t>(columns_[i])] =
            static_cast<float>(number(element, element.properties[i].type));
      }
    }
    if (!std::all_of(v.begin(), v.end(), [](float f) { return std::isfinite(f); })) {
      fail(element, "is not finite");
    }
    mesh_.positions.push_back({v[0], v[1], v[2]});
    if (has_normals_) mesh_.normals.push_back({v[3], v[4], v[5]});
    if (has_uvs_) mesh_.uvs.push_back({v[6], v[7]});
  }

  void read_face(const PlyElement& element) {
    for (const PlyProperty& property : element.properties) {
      const bool indices = property.name == "vertex_indices" || property.name == "vertex_index";
      if (indices && property.count_type) {
        read_polygon(element, property);
      } else {
        pass_over(element, property);
      }
    }
  }

  void read_polygon(const PlyElement& element, const PlyProperty& property) {
    const std::uint64_t corners = list_size(element, property);
    const std::uint64_t triangles =
        mesh_.triangles.size() + std::max<std::uint64_t>(corners, 2) - 2;
    check_triangle_count(static_cast<double>(triangles), "it");
    std::uint32_t first = 0, last = 0;
    for (std::uint64_t i = 0; i < corners; ++i) {
      const double value = number(element, property.type);
      const bool possible = value >= 0 && value <= 0xffffffff;
      if (!possible) fail(element, fmt::format("names vertex {}, which is missing", value));
      const auto index = static_cast<std::uint32_t>(value);
      if (i == 0) first = index;
      if (i >= 2) mesh_.triangles.push_back({first, last, index});
      last = index;
    }
  }

  /// Runs after all vertices are known, because faces may come first.
  void check_indices() const {
    for (const auto& triangle : mesh_.triangles) {
      const std::uint32_t largest = *std::max_element(triangle.begin(), triangle.end());
      if (largest < mesh_.positions.size()) continue;
      throw InputError(fmt::format("a face names vertex {}, which is missing", largest));
    }
  }

  PlyHeader header_;
  Numbers numbers_;
  TriangleMesh mesh_;
  std::vector<int> columns_;  ///< by property of a vertex
  bool has_normals_ = false, has_uvs_ = false;
  std::uint64_t row_ = 0;  ///< of the element being read
};

}  // namespace

TriangleMesh read_ply(std::string_view text) {
  return PlyReader(text).read();
}

}  // namespace pharos
