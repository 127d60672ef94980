#include "camera_mixture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "truncated_normal.h"

namespace pharos::vertex_triplets {
namespace {

/// Returns the sort key: the mean along an axis, then the other coordinates and the weight, so that
/// the result does not depend on the previous order.
std::array<float, 4> order_along(int axis, const SpatialGaussian& g) {
  return {g.mean[axis], g.mean[(axis + 1) % 3], g.mean[(axis + 2) % 3], g.weight};
}

}  // namespace

Bounds3 box_around(const SpatialGaussian& gaussian) {
  const float* l = gaussian.cholesky;
  const Vec3 reach =
      kTruncation * Vec3{l[0], std::abs(l[1]) + l[2], std::abs(l[3]) + std::abs(l[4]) + l[5]};
  Bounds3 box;
  box.add(gaussian.mean - reach);
  box.add(gaussian.mean + reach);
  return box;
}

CameraMixture::CameraMixture(std::vector<FirstVertex> components)
    : components_(std::move(components)) {
  if (components_.empty()) return;
  Bounds3 box;
  build({0, static_cast<std::uint32_t>(components_.size())}, box);
  double total = 0, sum = 0;
  for (const FirstVertex& component : components_) total += component.gaussian.weight;
  for (FirstVertex& component : components_) {
    boxes_.push_back(box_around(component.gaussian));
    component.gaussian.weight = static_cast<float>(component.gaussian.weight / total);
    shares_.push_back(sum += component.gaussian.weight);
  }
}

CameraMixture::Node::Node() {
  const Float8 most = all8(kInfinity);
  low = {most, most, most};
  high = {-most, -most, -most};
}

void CameraMixture::Node::set(unsigned lane, const Bounds3& box, std::uint32_t child) {
  low.x[lane] = box.low.x;
  low.y[lane] = box.low.y;
  low.z[lane] = box.low.z;
  high.x[lane] = box.high.x;
  high.y[lane] = box.high.y;
  high.z[lane] = box.high.z;
  children[lane] = child;
}

std::uint32_t CameraMixture::bisect(Range range) {
  Bounds3 means;
  for (std::uint32_t i = range.begin; i < range.end; ++i) means.add(components_[i].gaussian.mean);
  const Vec3 e = means.extent();
  const int axis = e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
  std::stable_sort(components_.begin() + range.begin, components_.begin() + range.end,
                   [&](const FirstVertex& a, const FirstVertex& b) {
                     return order_along(axis, a.gaussian) < order_along(axis, b.gaussian);
                   });
  return (range.begin + range.end) / 2;
}

std::uint32_t CameraMixture::build(Range range, Bounds3& box) {
  std::vector<Range> parts{range};
  for (int level = 0; level < 3; ++level) {
    std::vector<Range> halves;
    for (const Range& part : parts) {
      if (part.size() < 2) {
        halves.push_back(part);
        continue;
      }
      const std::uint32_t middle = bisect(part);
      halves.push_back({part.begin, middle});
      halves.push_back({middle, part.end});
    }
    parts = std::move(halves);
  }
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  for (unsigned lane = 0; lane < parts.size(); ++lane) {
    const Range& part = parts[lane];
    Bounds3 inside;
    std::uint32_t child = part.begin | kComponent;
    if (part.size() == 1) {
      inside = box_around(components_[part.begin].gaussian);
    } else {
      child = build(part, inside);
    }
    nodes_[index].set(lane, inside, child);
    box.add(inside);
  }
  return index;
}

std::size_t CameraMixture::choose(float u) const {
  const auto at = std::upper_bound(shares_.begin(), shares_.end(), u * shares_.back());
  return std::min(static_cast<std::size_t>(at - shares_.begin()), shares_.size() - 1);
}

std::size_t CameraMixture::size_bytes() const {
  return components_.size() * (sizeof(FirstVertex) + sizeof(Bounds3) + sizeof(double)) +
         nodes_.size() * sizeof(Node);
}

void FirstVertex::archive(Archive& archive) {
  archive(gaussian, kind);
  const float* l = gaussian.cholesky;
  archive.expect(gaussian.weight > 0 && l[0] > 0 && l[2] > 0 && l[5] > 0 &&
                     (kind == VertexKind::surface || kind == VertexKind::volume),
                 "the mixture at the camera");
}

void CameraMixture::archive(Archive& archive) {
  archive(components_);
  if (archive.loads()) *this = CameraMixture(std::move(components_));
}

}  // namespace pharos::vertex_triplets
