#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "octree_node.h"

namespace pharos::focal {

/// Hierarchical sample warping (McCool and Harwood 1997; Rath et al. 2023, eq. 5) over the cells of
/// an octree, in units of the octree's box. Each choice waits for the one before, so a step chooses
/// two levels at once: one of 4 x 4 x 4 cells. Immutable.
class OctreeWarp {
 public:
  /// `nodes` is in breadth-first order from the root.
  explicit OctreeWarp(const std::vector<OctreeNode>& nodes);

  /// Returns the mean density over the box [1/scene unit^3].
  double mean_density() const { return mean_density_; }
  /// Samples a point in [0, 1]^3 in proportion to the density, from random numbers in [0, 1). If
  /// the density is zero everywhere, it samples evenly.
  std::array<double, 3> sample(std::array<double, 3> u) const;
  std::size_t size_bytes() const {
    return fours_.size() * sizeof(Four) + twos_.size() * sizeof(Warp<2>);
  }

 private:
  /// A choice among N intervals of [0, 1).
  template <unsigned N>
  struct Choice {
    double begin[N];  ///< starts of the intervals
    float scale[N];   ///< reciprocals of their lengths, or 0

    /// Sets the intervals in proportion to weights, or evenly if all weights are zero.
    void set(const std::array<double, N>& weights);
    /// Selects the interval that contains `u`, and rescales `u` to [0, 1) for reuse. There is no
    /// branch, because it would be unpredictable.
    unsigned choose(double& u) const {
      unsigned k = 0;
      for (unsigned i = 1; i < N; ++i) k += u >= begin[i] ? 1 : 0;
      u = std::min((u - begin[k]) * scale[k], 1 - 0x1p-53);
      return k;
    }
  };

  /// Choices among N x N x N cells: x, y given x, z given x and y.
  template <unsigned N>
  struct alignas(64) Warp {
    Choice<N> x, y[N], z[N * N];

    /// Sets the choices for masses of cells x + N (y + N z).
    void set(const std::array<double, N * N * N>& masses);
    /// Selects a cell. Rescales the numbers for reuse.
    std::array<unsigned, 3> choose(std::array<double, 3>& u) const {
      const unsigned i = x.choose(u[0]);
      const unsigned j = y[i].choose(u[1]);
      return {i, j, z[i + N * j].choose(u[2])};
    }
  };

  /// The step that follows once a cell has been selected.
  class Next {
   public:
    /// Nothing follows: the cell is a leaf or a part of one.
    Next() = default;
    static Next two(std::size_t index) { return Next(static_cast<std::uint32_t>(index) << 1 | 1); }
    static Next four(std::size_t index) { return Next(static_cast<std::uint32_t>(index) << 1); }

    bool is_leaf() const { return word_ == kLeaf; }
    /// Returns whether the next step selects one of 2 x 2 x 2 leaves.
    bool is_two() const { return (word_ & 1) != 0; }
    std::size_t index() const { return word_ >> 1; }

   private:
    static constexpr std::uint32_t kLeaf = 0xffffffffu;
    explicit Next(std::uint32_t word) : word_(word) {}
    std::uint32_t word_ = kLeaf;
  };

  /// Two levels of the octree. A leaf of the upper level appears as eight cells of equal density.
  struct Four {
    Warp<4> warp;
    std::array<Next, 64> next;
  };

  Next add(const std::vector<OctreeNode>& nodes, const std::vector<double>& means, std::size_t i);

  std::vector<Four> fours_;
  std::vector<Warp<2>> twos_;
  Next first_;
  double mean_density_ = 0;
};

}  // namespace pharos::focal
