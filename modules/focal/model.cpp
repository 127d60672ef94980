#include "model.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <pharos/core/binary_stream.h>

#include "octree_file.h"

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

FocalModel::FocalModel(std::istream& in) {
  expect_heading(in, kFocalModel, kVersion);
  density_.converging = load_octree(in);
  density_.diverging = load_octree(in);
  // Directions are drawn as if the masses added up to one: a density that does not is no density.
  constexpr double kRounding = 1e-4;
  const double mass = density_.converging.mass() + density_.diverging.mass();
  const bool is_sound =
      density_.converging.box() == density_.diverging.box() && std::abs(mass - 1) <= kRounding;
  if (!is_sound) throw InputError("the focal model is damaged");
}

void FocalModel::save(std::ostream& out) const {
  save_heading(out, kFocalModel, kVersion);
  save_octree(density_.converging, out);
  save_octree(density_.diverging, out);
}

Bounds3 FocalModel::bounds() const {
  const Box& box = density_.converging.box();
  return {to_float(box.low), to_float(box.low) + to_float(box.size)};
}

std::vector<ModelFact> FocalModel::facts() const {
  return {depth_fact("converging", density_.converging),
          depth_fact("diverging", density_.diverging),
          {"share of diverging points", fmt::format("{:.4f}", density_.diverging.mass())}};
}

}  // namespace pharos::focal
