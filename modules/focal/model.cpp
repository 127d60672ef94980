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

/// Returns whether an octree pair is a density over the box. Sampling assumes that the masses add
/// up to one.
bool is_density(const FocalDensity& density, const Box& box) {
  constexpr double kRounding = 1e-4;
  const double mass = density.converging.mass() + density.diverging.mass();
  return density.converging.box() == box && density.diverging.box() == box &&
         std::abs(mass - 1) <= kRounding;
}

}  // namespace

FocalModel::FocalModel(FocalDensity density, float segments, std::vector<FocalDensity> local,
                       int per_axis)
    : density_(std::move(density)),
      segments_(segments),
      per_axis_(per_axis),
      local_(std::move(local)),
      grid_(density_.converging.box(), per_axis) {}

ModelInfo FocalModel::info() const {
  ModelInfo info{.name = std::string(kName), .version = 4, .bytes = density_.size_bytes()};
  for (const FocalDensity& local : local_) info.bytes += local.size_bytes();
  const Box& box = density_.converging.box();
  info.bounds = {to_float(box.low), to_float(box.low) + to_float(box.size)};
  info.facts = {depth_fact("converging", density_.converging),
                depth_fact("diverging", density_.diverging),
                {"share of diverging points", fmt::format("{:.4f}", density_.diverging.mass())}};
  if (!local_.empty()) info.facts.push_back({"cells of space", fmt::format("{}", local_.size())});
  return info;
}

void FocalModel::archive(Archive& archive) {
  archive(density_, segments_, per_axis_, local_);
  const Box& box = density_.converging.box();
  bool is_sound = segments_ >= 0 && per_axis_ >= 1 && is_density(density_, box);
  grid_ = CellGrid(box, per_axis_);
  is_sound &= local_.empty() || local_.size() == grid_.count();
  for (const FocalDensity& local : local_) is_sound &= is_density(local, box);
  archive.expect(is_sound, "the focal model");
}

}  // namespace pharos::focal
