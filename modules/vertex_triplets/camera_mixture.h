#pragma once

#include <cstdint>
#include <iosfwd>
#include <span>
#include <vector>

#include <pharos/core/bounds.h>
#include <pharos/guiding/contract/spatial_mixture.h>
#include <pharos/scene/events.h>

namespace pharos::vertex_triplets {

/// A component of where paths from the sensor have their first vertices. The weight is its share.
struct FirstVertex {
  SpatialGaussian gaussian;
  VertexKind kind = VertexKind::surface;
};

/// The mixture of all first vertices (Schuessler et al. 2022, section 4.2): truncated Gaussians
/// within boxes, found by a hierarchy of these.
class CameraMixture {
 public:
  CameraMixture() : CameraMixture(std::vector<FirstVertex>{}) {}
  /// Weights > 0, of which shares are made.
  explicit CameraMixture(std::vector<FirstVertex> components);

  bool empty() const { return components_.empty(); }
  std::size_t size() const { return components_.size(); }
  const FirstVertex& operator[](std::size_t i) const { return components_[i]; }
  /// The box that a component's first vertices lie in [scene units].
  const Bounds3& box(std::size_t i) const { return boxes_[i]; }
  /// The component of a number in [0, 1).
  std::size_t choose(float u) const;

  /// Calls `visit(component)` for those whose boxes hold the point.
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
  void save(std::ostream& out) const;
  /// Throws InputError when it is damaged.
  static CameraMixture load(std::istream& in);

 private:
  static constexpr int kMostLevels = 64;  ///< halves of 2^32 components need 32 and one more

  /// Two nodes from `first` on, or components.
  struct Node {
    Bounds3 box;
    std::uint32_t first, count;
  };
  void build(std::uint32_t node, std::uint32_t begin, std::uint32_t end);

  std::vector<FirstVertex> components_;  ///< in the order of nodes
  std::vector<Bounds3> boxes_;
  std::vector<double> shares_;  ///< up to and including each component
  std::vector<Node> nodes_;
};

/// The box around a truncated Gaussian: 4 times the sums of the factor's rows to both sides of the
/// mean.
Bounds3 box_around(const SpatialGaussian& gaussian);

}  // namespace pharos::vertex_triplets
