#include "lobe_mixture.h"

#include <algorithm>
#include <cmath>

#include <pharos/core/binary_stream.h>

#include "vmf.h"

namespace pharos::parallax_aware_mixtures {
namespace {

constexpr std::uint32_t kMostGroups = 1u << 20;
constexpr float kMostKappa = 1e8f;

void expect(bool holds) {
  if (!holds) throw InputError("the model of von Mises-Fisher mixtures is damaged");
}

LobeGroup empty_group() {
  LobeGroup group;
  group.mean[2] = all8(1);
  group.kappa = all8(kLeastKappa);
  group.mode = all8(static_cast<float>(mode_density(kLeastKappa)));
  return group;
}

void set_shape(LobeGroup& group, std::size_t lane, float kappa) {
  group.kappa[lane] = kappa;
  group.mode[lane] = static_cast<float>(mode_density(kappa));
}

}  // namespace

void append_groups(const Mixture& mixture, std::span<const double> inverse_distances,
                   std::vector<LobeGroup>& groups) {
  for (std::size_t k = 0; k < mixture.size(); ++k) {
    const std::size_t lane = k % kLanes;
    if (lane == 0) groups.push_back(empty_group());
    LobeGroup& group = groups.back();
    group.weight[lane] = static_cast<float>(mixture[k].weight);
    for (int axis = 0; axis < 3; ++axis) {
      group.mean[axis][lane] = static_cast<float>(mixture[k].mean[axis]);
    }
    set_shape(group, lane, std::max(static_cast<float>(mixture[k].kappa), kLeastKappa));
    group.inverse_distance[lane] = static_cast<float>(inverse_distances[k]);
  }
}

void save_groups(std::span<const LobeGroup> groups, std::ostream& out) {
  save_number(out, static_cast<std::uint32_t>(groups.size()));
  for (const LobeGroup& group : groups) {
    for (const Float8* numbers : {&group.weight, &group.mean[0], &group.mean[1], &group.mean[2],
                                  &group.kappa, &group.inverse_distance}) {
      for (std::size_t i = 0; i < kLanes; ++i) save_number(out, (*numbers)[i]);
    }
  }
}

std::vector<LobeGroup> load_groups(std::istream& in) {
  const auto count = load_number<std::uint32_t>(in);
  expect(count <= kMostGroups);
  std::vector<LobeGroup> groups;
  double total = 0;
  while (groups.size() < count) {
    LobeGroup& group = groups.emplace_back();
    for (Float8* numbers : {&group.weight, &group.mean[0], &group.mean[1], &group.mean[2],
                            &group.kappa, &group.inverse_distance}) {
      for (std::size_t i = 0; i < kLanes; ++i) (*numbers)[i] = load_finite<float>(in);
    }
    for (std::size_t i = 0; i < kLanes; ++i) {
      const Vec3 mean{group.mean[0][i], group.mean[1][i], group.mean[2][i]};
      const float kappa = group.kappa[i];
      expect(group.weight[i] >= 0 && kappa >= kLeastKappa && kappa <= kMostKappa &&
             std::abs(length_squared(mean) - 1) < 1e-4f && group.inverse_distance[i] >= 0 &&
             group.inverse_distance[i] <= kLargestInverse);
      set_shape(group, i, kappa);
      total += group.weight[i];
    }
  }
  // Directions are drawn as if the weights added up to one.
  expect(count == 0 || std::abs(total - 1) < 1e-4);
  return groups;
}

}  // namespace pharos::parallax_aware_mixtures
