#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include <pharos/sampling/sampler.h>

namespace pharos::test {

/// Returns `count` samples, beginning with number `first`, of one dimension of the path of `key`.
inline std::vector<Vec2> points_of(const PreparedSampler& sampler, PathKey key, Dimension dimension,
                                   std::uint32_t count, std::uint32_t first = 0) {
  std::vector<Vec2> points;
  for (key.sample = first; key.sample < first + count; ++key.sample) {
    points.push_back(SampleStream(sampler, key).get_2d(dimension));
  }
  return points;
}

/// Returns the same for 1D numbers, as the points (u, 0).
inline std::vector<Vec2> numbers_of(const PreparedSampler& sampler, PathKey key,
                                    Dimension dimension, std::uint32_t count) {
  std::vector<Vec2> points;
  for (key.sample = 0; key.sample < count; ++key.sample) {
    points.push_back({SampleStream(sampler, key).get_1d(dimension), 0});
  }
  return points;
}

/// Returns whether all cells of a grid of `columns` by `rows` cells hold equally many points.
inline bool fills_grid(const std::vector<Vec2>& points, std::size_t columns, std::size_t rows) {
  std::vector<std::size_t> counts(columns * rows);
  for (const Vec2 p : points) {
    const auto x = static_cast<std::size_t>(double{p.x} * static_cast<double>(columns));
    const auto y = static_cast<std::size_t>(double{p.y} * static_cast<double>(rows));
    ++counts[y * columns + x];
  }
  for (const std::size_t count : counts) {
    if (count * counts.size() != points.size()) return false;
  }
  return true;
}

}  // namespace pharos::test
