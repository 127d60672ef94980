#pragma once

#include <cmath>
#include <vector>

#include <pharos/core/random.h>
#include <pharos/core/warp.h>
#include <pharos/statistics/von_mises_fisher.h>

#include "../lobe_mixture.h"

namespace pharos::parallax_aware_mixtures::testing {

inline Direction to_direction(Vec3 v) {
  return Direction(v.x, v.y, v.z).normalized();
}
inline Vec3 to_vec(const Direction& d) {
  return {static_cast<float>(d[0]), static_cast<float>(d[1]), static_cast<float>(d[2])};
}
inline Vec3 any_direction(RandomStream& random) {
  return warp::sphere_from_square(random.next_2d());
}
inline double log_uniform(double low, double high, RandomStream& random) {
  return low * std::pow(high / low, double{random.next_1d()});
}

/// Returns the density of a lobe [1/sr], in double precision.
inline double density_of(const Lobe& lobe, Vec3 w) {
  const Direction d = to_direction(w);
  return von_mises_fisher::mode_density(lobe.kappa) * std::exp(lobe.kappa * (lobe.mean.dot(d) - 1));
}
inline double density_of(const Mixture& mixture, Vec3 w) {
  double sum = 0;
  for (const Lobe& lobe : mixture) sum += lobe.weight * density_of(lobe, w);
  return sum;
}

/// Returns random lobes with concentrations between `least` and `most`.
inline Mixture any_mixture(std::size_t count, double least, double most, RandomStream& random) {
  Mixture mixture;
  double total = 0;
  for (std::size_t k = 0; k < count; ++k) {
    mixture.push_back({0.2 + random.next_1d(), to_direction(any_direction(random)),
                       log_uniform(least, most, random)});
    total += mixture.back().weight;
  }
  for (Lobe& lobe : mixture) lobe.weight /= total;
  return mixture;
}

/// Returns a direction sampled from a mixture.
inline Vec3 draw_from(const Mixture& mixture, RandomStream& random) {
  double choice = random.next_1d();
  std::size_t k = 0;
  while (k + 1 < mixture.size() && choice >= mixture[k].weight) choice -= mixture[k++].weight;
  return von_mises_fisher::sample(to_vec(mixture[k].mean), static_cast<float>(mixture[k].kappa),
                                  random.next_2d());
}

}  // namespace pharos::parallax_aware_mixtures::testing
