#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pharos {

/// Numbers distinct vertices in the order of their first occurrence. A vertex consists of `n` words
/// of 32 bits: indices, or the bits of its coordinates.
template <std::size_t n>
class VertexTable {
 public:
  using Words = std::array<std::uint32_t, n>;

  /// Makes a table for at most `most` different vertices.
  explicit VertexTable(std::size_t most) : slots_(std::bit_ceil(2 * most + 1), kNone) {}

  /// Returns the number of a vertex, and enters the vertex if it is new.
  std::uint32_t number_of(const Words& vertex) {
    // Linear probing; the table is at most half full.
    std::size_t slot = hash(vertex) & (slots_.size() - 1);
    for (; slots_[slot] != kNone; slot = (slot + 1) & (slots_.size() - 1)) {
      if (vertices_[slots_[slot]] == vertex) return slots_[slot];
    }
    vertices_.push_back(vertex);
    return slots_[slot] = static_cast<std::uint32_t>(vertices_.size() - 1);
  }

  /// Returns the vertices in the order of their numbers.
  const std::vector<Words>& vertices() const { return vertices_; }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  static std::uint64_t hash(const Words& vertex) {
    std::uint64_t h = 0;
    for (const std::uint32_t word : vertex) {
      h = (h ^ word) * 0x9e3779b97f4a7c15u;
      h ^= h >> 32;
    }
    return h;
  }

  std::vector<std::uint32_t> slots_;  ///< numbers of the vertices
  std::vector<Words> vertices_;
};

}  // namespace pharos
