// PLY files that are damaged, state a wrong size, or contain no surface.

#include <array>
#include <cstring>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "refusal.h"

namespace pharos::testing {
namespace {

std::string ply_header(const std::string& format, const std::string& vertices,
                       const std::string& faces) {
  return fmt::format(
      "ply\nformat {} 1.0\nelement vertex {}\nproperty float x\nproperty float y\n"
      "property float z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      format, vertices, faces);
}

std::string ascii_ply(const std::string& body) {
  return ply_header("ascii", "3", "1") + body;
}

/// A triangle with these vertex indices.
std::string binary_ply(const std::array<int, 3>& indices) {
  const std::array<float, 9> positions{0, 0, 0, 1, 0, 0, 0, 1, 0};
  std::string body(sizeof positions + 1 + sizeof indices, '\3');
  std::memcpy(body.data(), positions.data(), sizeof positions);
  std::memcpy(body.data() + sizeof positions + 1, indices.data(), sizeof indices);
  return ply_header("binary_little_endian", "3", "1") + body;
}

TEST_CASE("PLY: cut off") {
  const std::string ascii = ascii_ply("0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const std::string binary = binary_ply({0, 1, 2});
  for (const std::size_t kept : {0, 3, 20, 90, 170}) {
    check_mesh_refused("cut.ply", ascii.substr(0, kept));
  }
  check_mesh_refused("cut.ply", ascii.substr(0, ascii.size() - 12));
  for (const std::size_t lost : {1, 10, 14, 30}) {
    check_mesh_refused("cut.ply", binary.substr(0, binary.size() - lost));
  }
}

TEST_CASE("PLY: counts that are not true") {
  for (const char* count : {"2147483648", "4294967295", "99999999999999999999", "-1", "many"}) {
    for (const char* format : {"ascii", "binary_little_endian"}) {
      check_mesh_refused("count.ply", ply_header(format, count, "1") + "0 0 0\n");
      check_mesh_refused("count.ply", ply_header(format, "0", count) + "0 0 0\n");
    }
  }
}

TEST_CASE("PLY: vertices and faces that cannot be") {
  for (const char* number : {"nan", "inf", "-inf", "1e999", "x"}) {
    check_mesh_refused("number.ply",
                       ascii_ply(fmt::format("0 0 0\n1 0 0\n0 {} 0\n3 0 1 2\n", number)));
  }
  check_mesh_refused("index.ply", ascii_ply("0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"));
  check_mesh_refused("index.ply", ascii_ply("0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n"));
  check_mesh_refused("index.ply", binary_ply({0, 1, 3}));
  check_mesh_refused("index.ply", binary_ply({0, 1, -1}));
  check_mesh_refused("index.ply", binary_ply({0, 1, 2147483647}));
  check_mesh_refused("line.ply", ascii_ply("0 0 0\n1 0 0\n0 1 0\n2 0 1\n"));
}

}  // namespace
}  // namespace pharos::testing
