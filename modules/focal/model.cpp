#include "model.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace pharos::focal {
namespace {

ModelFact depth_fact(const char* name, const Octree& octree) {
  return {fmt::format("{} octree", name),
          fmt::format("{} leaves, {} levels", octree.leaf_count(), octree.depth())};
}

Vec3 to_float(const Double3& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

}  // namespace

ModelInfo FocalModel::info() const {
  ModelInfo info{.name = std::string(kName), .version = 3, .bytes = density_.size_bytes()};
  const Box& box = density_.converging.box();
  info.bounds = {to_float(box.low), to_float(box.low) + to_float(box.size)};
  info.facts = {depth_fact("converging", density_.converging),
                depth_fact("diverging", density_.diverging),
                {"share of diverging points", fmt::format("{:.4f}", density_.diverging.mass())}};
  return info;
}

void FocalModel::archive(Archive& archive) {
  archive(density_.converging, density_.diverging, segments_);
  // Sampling assumes that the masses add up to one.
  constexpr double kRounding = 1e-4;
  const double mass = density_.converging.mass() + density_.diverging.mass();
  archive.expect(density_.converging.box() == density_.diverging.box() && segments_ >= 0 &&
                     std::abs(mass - 1) <= kRounding,
                 "the focal model");
}

}  // namespace pharos::focal
