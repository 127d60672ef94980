#include "camera_mixture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <pharos/core/binary_stream.h>

#include "truncated_normal.h"

namespace pharos::vertex_triplets {
namespace {

/// By the mean along an axis; by all else where means are level, so that the order before does not
/// matter.
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

void CameraMixture::save(std::ostream& out) const {
  save_number(out, static_cast<std::uint32_t>(size()));
  for (const FirstVertex& component : components_) {
    const SpatialGaussian& g = component.gaussian;
    save_number(out, g.weight);
    for (int axis = 0; axis < 3; ++axis) save_number(out, g.mean[axis]);
    for (const float l : g.cholesky) save_number(out, l);
    save_number(out, static_cast<std::uint8_t>(component.kind));
  }
}

CameraMixture CameraMixture::load(std::istream& in) {
  std::vector<FirstVertex> components;
  for (auto count = load_number<std::uint32_t>(in); count > 0; --count) {
    FirstVertex& component = components.emplace_back();
    SpatialGaussian& g = component.gaussian;
    g.weight = load_finite<float>(in);
    for (int axis = 0; axis < 3; ++axis) g.mean[axis] = load_finite<float>(in);
    for (float& l : g.cholesky) l = load_finite<float>(in);
    const auto kind = load_number<std::uint8_t>(in);
    component.kind = static_cast<VertexKind>(kind);
    const bool fits =
        g.weight > 0 && g.cholesky[0] > 0 && g.cholesky[2] > 0 && g.cholesky[5] > 0 &&
        (component.kind == VertexKind::surface || component.kind == VertexKind::volume);
    if (!fits) throw InputError("the mixture at the camera is damaged");
  }
  return CameraMixture(std::move(components));
}

}  // namespace pharos::vertex_triplets
