#include "stl_file.h"

#include <array>
#include <cstring>

#include <fmt/core.h>

#include <pharos/core/error.h>

#include "text_scanner.h"
#include "triangle_shape.h"

namespace pharos {
namespace {

// A binary file consists of free text, the number of triangles, and for each triangle its normal,
// its vertices and two bytes of arbitrary data.
constexpr std::size_t kTextSize = 80;
constexpr std::size_t kBinaryHeaderSize = kTextSize + sizeof(std::uint32_t);
constexpr std::size_t kTriangleSize = 50;
constexpr std::size_t kNormalSize = 12;

std::uint32_t binary_count(std::string_view bytes) {
  std::uint32_t count;
  std::memcpy(&count, bytes.data() + kTextSize, sizeof(count));
  return count;
}

/// Returns whether the file is text. Text begins with "solid". Some programs begin binary files
/// with the same word; the size of the file distinguishes them.
bool is_text(std::string_view bytes) {
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || !bytes.substr(first).starts_with("solid")) return false;
  return bytes.size() < kBinaryHeaderSize ||
         bytes.size() != kBinaryHeaderSize + kTriangleSize * std::uint64_t{binary_count(bytes)};
}

/// Adds a triangle with three new vertices. Equal vertices are joined later.
void add_triangle(TriangleMesh& mesh, const std::array<Point3, 3>& corners) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), corners.begin(), corners.end());
  mesh.triangles.push_back({first, first + 1, first + 2});
}

TriangleMesh read_binary(std::string_view bytes) {
  if (bytes.size() < kBinaryHeaderSize) throw InputError("it is too short for an STL file");
  const std::uint64_t count = binary_count(bytes);
  if (count > (bytes.size() - kBinaryHeaderSize) / kTriangleSize) {
    throw InputError(fmt::format("it ends before its {} triangles", count));
  }
  check_triangle_count(static_cast<double>(count), "it");
  TriangleMesh mesh;
  mesh.positions.reserve(3 * count);
  mesh.triangles.reserve(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    std::array<Point3, 3> corners;
    static_assert(sizeof(corners) == 36);
    std::memcpy(&corners, bytes.data() + kBinaryHeaderSize + kTriangleSize * i + kNormalSize,
                sizeof(corners));
    for (const Point3 p : corners) {
      if (!is_finite(p)) throw InputError(fmt::format("a vertex of triangle {} is not finite", i));
    }
    add_triangle(mesh, corners);
  }
  return mesh;
}

/// Reads any number of
///   solid NAME
///     facet normal X Y Z  outer loop  vertex X Y Z (three times)  endloop  endfacet
///   endsolid NAME
/// Line breaks may occur anywhere except within the names.
class TextReader {
 public:
  explicit TextReader(const MeshSource& source) : scanner_(source.bytes, source.path.string()) {}

  TriangleMesh read() {
    for (std::string_view word = next(); !word.empty(); word = next()) {
      if (word != "solid") refuse(word, "solid");
      scanner_.rest();
      read_solid();
    }
    return std::move(mesh_);
  }

 private:
  void pass_over_breaks() {
    while (!scanner_.has_word() && scanner_.next_line()) {
    }
  }

  std::string_view next() {
    pass_over_breaks();
    return scanner_.word();
  }

  float next_number() {
    pass_over_breaks();
    return scanner_.number();
  }

  Point3 next_point() {
    const float x = next_number(), y = next_number();
    return {x, y, next_number()};
  }

  void expect(std::string_view expected) {
    const std::string_view word = next();
    if (word != expected) refuse(word, expected);
  }

  [[noreturn]] void refuse(std::string_view found, std::string_view expected) const {
    scanner_.fail(found.empty()
                      ? fmt::format("the file ends where '{}' should follow", expected)
                      : fmt::format("expected '{}', found '{}'", expected, one_line(found, 40)));
  }

  void read_solid() {
    for (std::string_view word = next(); word != "endsolid"; word = next()) {
      if (word != "facet") refuse(word, "facet");
      read_facet();
    }
    scanner_.rest();
  }

  void read_facet() {
    expect("normal");
    for (int i = 0; i < 3; ++i) next();  // the normal, which may be NaN if the facet has no area
    expect("outer");
    expect("loop");
    std::array<Point3, 3> corners;
    for (Point3& corner : corners) {
      expect("vertex");
      corner = next_point();
    }
    expect("endloop");
    expect("endfacet");
    add_triangle(mesh_, corners);
    check_triangle_count(static_cast<double>(mesh_.triangles.size()), "it");
  }

  TextScanner scanner_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh read_stl(const MeshSource& source) {
  return is_text(source.bytes) ? TextReader(source).read() : read_binary(source.bytes);
}

}  // namespace pharos
