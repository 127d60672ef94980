#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include <pharos/core/bounds.h>
#include <pharos/core/lanes3.h>
#include <pharos/core/simd.h>
#include <pharos/guiding/contract/spatial_gaussian.h>
#include <pharos/scene/events.h>

namespace pharos::vertex_triplets {

/// A component of the distribution of first vertices of paths from the sensor. The weight is its
/// share.
struct FirstVertex {
  SpatialGaussian gaussian;
  VertexKind kind = VertexKind::surface;
  void archive(Archive& archive);
};

/// The mixture of all first vertices (Schuessler et al. 2022, section 4.2): truncated Gaussians,
/// with a hierarchy of their bounding boxes.
class CameraMixture {
 public:
  CameraMixture() : CameraMixture(std::vector<FirstVertex>{}) {}
  /// Makes the mixture of components with weights > 0, which it normalizes to shares.
  explicit CameraMixture(std::vector<FirstVertex> components);

  bool empty() const { return components_.empty(); }
  std::size_t size() const { return components_.size(); }
  const FirstVertex& operator[](std::size_t i) const { return components_[i]; }
  /// Returns the box that contains the first vertices of a component [scene units].
  const Bounds3& box(std::size_t i) const { return boxes_[i]; }
  /// Chooses a component by a number in [0, 1).
  std::size_t choose(float u) const;

  /// Calls `visit(component)` for all components whose boxes contain the point.
  template <class Visit>
  void for_each_around(Point3 point, Visit&& visit) const {
    if (nodes_.empty()) return;
    std::uint32_t stack[kMostWaiting];
    int waiting = 0;
    stack[waiting++] = 0;
    while (waiting > 0) {
      const Node& node = nodes_[stack[--waiting]];
      for (unsigned left = bits_of(node.contain(point)); left != 0; left &= left - 1) {
        const std::uint32_t child = node.children[std::countr_zero(left)];
        if ((child & kComponent) != 0) {
          visit(child ^ kComponent);
        } else {
          stack[waiting++] = child;
        }
      }
    }
  }

  std::size_t size_bytes() const;
  void archive(Archive& archive);

 private:
  /// Eight children per level: 11 levels suffice for 2^31 components.
  static constexpr int kMostWaiting = 7 * 11 + 1;
  static constexpr std::uint32_t kComponent = 0x80000000u;  ///< marks children that are components

  /// Up to eight children with their boxes, each a node or a component. The boxes of missing
  /// children are empty.
  struct Node {
    Node();
    void set(unsigned lane, const Bounds3& box, std::uint32_t child);
    /// Returns the children whose boxes contain the point.
    Mask8 contain(Point3 p) const {
      return (low.x <= p.x) & (p.x <= high.x) & (low.y <= p.y) & (p.y <= high.y) & (low.z <= p.z) &
             (p.z <= high.z);
    }

    Lanes3<Float8> low, high;
    std::array<std::uint32_t, 8> children{};
  };
  /// The components from `begin` up to, but without, `end`.
  struct Range {
    std::uint32_t begin, end;

    std::uint32_t size() const { return end - begin; }
  };

  /// Returns the middle of a range after sorting it along the longest extent of the means.
  std::uint32_t bisect(Range range);
  /// Adds a node for a range, and all nodes below. Returns its index. Fills in `box`.
  std::uint32_t build(Range range, Bounds3& box);

  std::vector<FirstVertex> components_;  ///< in the order of the leaves
  std::vector<Bounds3> boxes_;
  std::vector<double> shares_;  ///< sum of the shares up to and including each component
  std::vector<Node> nodes_;
};

/// Returns the box around a truncated Gaussian. It reaches 4 times the sum of the absolute values
/// in each row of the Cholesky factor to both sides of the mean.
Bounds3 box_around(const SpatialGaussian& gaussian);

}  // namespace pharos::vertex_triplets
