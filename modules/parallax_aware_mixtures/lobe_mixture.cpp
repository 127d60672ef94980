#include "lobe_mixture.h"

#include <algorithm>
#include <cmath>

#include <pharos/statistics/von_mises_fisher.h>

namespace pharos::parallax_aware_mixtures {
namespace {

constexpr std::size_t kMostGroups = 1u << 20;
constexpr float kMostKappa = 1e8f;

LobeGroup empty_group() {
  LobeGroup group;
  group.mean[2] = all8(1);
  group.kappa = all8(von_mises_fisher::kLeastKappa);
  group.mode =
      all8(static_cast<float>(von_mises_fisher::mode_density(von_mises_fisher::kLeastKappa)));
  return group;
}

void set_shape(LobeGroup& group, std::size_t lane, float kappa) {
  group.kappa[lane] = kappa;
  group.mode[lane] = static_cast<float>(von_mises_fisher::mode_density(kappa));
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
    set_shape(group, lane,
              std::max(static_cast<float>(mixture[k].kappa), von_mises_fisher::kLeastKappa));
    group.inverse_distance[lane] = static_cast<float>(inverse_distances[k]);
  }
}

void LobeGroup::archive(Archive& archive) {
  for (Float8* numbers : {&weight, &mean[0], &mean[1], &mean[2], &kappa, &inverse_distance}) {
    for (std::size_t i = 0; i < kLanes; ++i) {
      float number = (*numbers)[i];
      archive(number);
      if (archive.loads()) (*numbers)[i] = number;
    }
  }
  for (std::size_t i = 0; archive.loads() && i < kLanes; ++i) set_shape(*this, i, kappa[i]);
}

bool is_sound(const std::vector<LobeGroup>& groups) {
  if (groups.empty()) return true;
  double total = 0;
  for (const LobeGroup& group : groups) {
    for (std::size_t i = 0; i < kLanes; ++i) {
      const Vec3 mean{group.mean[0][i], group.mean[1][i], group.mean[2][i]};
      const float kappa = group.kappa[i];
      const bool is_lobe = group.weight[i] >= 0 && kappa >= von_mises_fisher::kLeastKappa &&
                           kappa <= kMostKappa && std::abs(length_squared(mean) - 1) < 1e-4f &&
                           group.inverse_distance[i] >= 0 &&
                           group.inverse_distance[i] <= kLargestInverse;
      if (!is_lobe) return false;
      total += group.weight[i];
    }
  }
  // Sampling assumes that the weights add up to one.
  return groups.size() <= kMostGroups && std::abs(total - 1) < 1e-4;
}

}  // namespace pharos::parallax_aware_mixtures
