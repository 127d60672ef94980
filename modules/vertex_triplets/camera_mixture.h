#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <pharos/core/bounds.h>
#include <pharos/guiding/contract/spatial_mixture.h>
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
    std::uint32_t stack[kMostLevels];
    int waiting = 0;
    stack[waiting++] = 0;
    while (waiting > 0) {
      const Node& node = nodes_[stack[--waiting]];
      if (!node.box.contains(point)) continue;
      if (node.count == 0) {
        stack[waiting++] = node.first;
        stack[waiting++] = node.first + 1;
      }
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        if (boxes_[i].contains(point)) visit(i);
      }
    }
  }

  std::size_t size_bytes() const;
  void archive(Archive& archive);

 private:
  static constexpr int kMostLevels = 64;  ///< 33 suffice to bisect 2^32 components

  /// An inner node (count 0) with two children from `first` on, or a leaf with components.
  struct Node {
    Bounds3 box;
    std::uint32_t first, count;
  };
  void build(std::uint32_t node, std::uint32_t begin, std::uint32_t end);

  std::vector<FirstVertex> components_;  ///< in the order of the leaves
  std::vector<Bounds3> boxes_;
  std::vector<double> shares_;  ///< sum of the shares up to and including each component
  std::vector<Node> nodes_;
};

/// Returns the box around a truncated Gaussian. It reaches 4 times the sum of the absolute values
/// in each row of the Cholesky factor to both sides of the mean.
Bounds3 box_around(const SpatialGaussian& gaussian);

}  // namespace pharos::vertex_triplets
