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
  nodes_.push_back({});
  build(0, 0, static_cast<std::uint32_t>(components_.size()));
  double total = 0, sum = 0;
  for (const FirstVertex& component : components_) total += component.gaussian.weight;
  for (FirstVertex& component : components_) {
    boxes_.push_back(box_around(component.gaussian));
    component.gaussian.weight = static_cast<float>(component.gaussian.weight / total);
    shares_.push_back(sum += component.gaussian.weight);
  }
}

void CameraMixture::build(std::uint32_t node, std::uint32_t begin, std::uint32_t end) {
  constexpr std::uint32_t kMostInLeaf = 4;
  Bounds3 box, means;
  for (std::uint32_t i = begin; i < end; ++i) {
    box.add(box_around(components_[i].gaussian));
    means.add(components_[i].gaussian.mean);
  }
  if (end - begin <= kMostInLeaf) {
    nodes_[node] = {box, begin, end - begin};
    return;
  }
  const Vec3 e = means.extent();
  const int axis = e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
  const std::uint32_t middle = (begin + end) / 2;
  std::stable_sort(components_.begin() + begin, components_.begin() + end,
                   [&](const FirstVertex& a, const FirstVertex& b) {
                     return order_along(axis, a.gaussian) < order_along(axis, b.gaussian);
                   });
  const auto first = static_cast<std::uint32_t>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  nodes_[node] = {box, first, 0};
  build(first, begin, middle);
  build(first + 1, middle, end);
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
