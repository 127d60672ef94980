#include "rough_coat.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <tuple>

#include "fresnel.h"

namespace pharos {

RoughCoat::RoughCoat(FacetDistribution distribution, float alpha, float ior, Masking masking)
    : facets_(distribution, alpha, alpha), ior_(ior), masking_(masking) {
  // The materials of a scene, and the runs of an experiment, often have equal coats.
  using Key = std::tuple<FacetDistribution, float, float, Masking>;
  static std::map<Key, Table> tables;
  static std::mutex mutex;
  const Key key{distribution, alpha, ior, masking};
  {
    const std::lock_guard lock(mutex);
    if (const auto found = tables.find(key); found != tables.end()) {
      transmittance_ = found->second;
      return;
    }
  }
  transmittance_ = tabulated_transmittance();
  const std::lock_guard lock(mutex);
  tables.emplace(key, transmittance_);
}

RoughCoat::Table RoughCoat::tabulated_transmittance() const {
  Table table;
  for (std::size_t i = 0; i <= kIntervals; ++i) {
    const float x = static_cast<float>(i) / kIntervals;
    table[i] = std::max(0.0f, 1 - reflectance(square(square(x))));
  }
  return table;
}

float RoughCoat::transmittance(float cosine) const {
  const float x = kIntervals * std::sqrt(std::sqrt(std::min(1.0f, cosine)));
  const std::size_t i = std::min(static_cast<std::size_t>(x), kIntervals - 1);
  return lerp(transmittance_[i], transmittance_[i + 1], x - static_cast<float>(i));
}

RoughCoat::Reflection RoughCoat::reflect(Vec3 wo, Vec3 wi) const {
  const std::optional<Vec3> m = half_vector(wo, wi);
  if (!m) return {};
  const float fresnel = dielectric_fresnel(std::min(1.0f, dot(wo, *m)), ior_).reflectance;
  const auto [shadowing, pdf] = facets_.mirrored(wo, wi, *m, masking_);
  return {fresnel * shadowing, pdf};
}

Vec3 RoughCoat::sample(Vec3 wo, Vec2 u) const {
  const Vec3 m = facets_.sample_visible_normal(wo, u);
  return normalize(2 * dot(wo, m) * m - wo);
}

/// The mean of F G2 / G1 over visible normals, by the midpoint rule over the two random numbers. By
/// symmetry half of the range of u.x suffices. Points are denser at both ends of u.y, where facets
/// turn away from view or are steepest.
float RoughCoat::reflectance(float cosine) const {
  constexpr int kPoints = 40;
  const Vec3 wo{safe_sqrt((1 - cosine) * (1 + cosine)), 0, cosine};
  double sum = 0;
  for (int i = 0; i < kPoints; ++i) {
    const float t = (static_cast<float>(i) + 0.5f) / kPoints;
    const float y = t * t * (3 - 2 * t), spacing = 6 * t * (1 - t);
    for (int j = 0; j < kPoints; ++j) {
      const float half_x = 0.5f * (static_cast<float>(j) + 0.5f) / kPoints;
      const Vec3 wi = sample(wo, {half_x, y});
      if (wi.z > 0) sum += double{spacing} * double{reflect(wo, wi).weight};
    }
  }
  return static_cast<float>(sum / (kPoints * kPoints));
}

}  // namespace pharos
