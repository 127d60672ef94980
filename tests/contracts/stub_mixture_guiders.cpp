// Stub (g), the guiders: two ways to sample any model that is a SpatialMixture. `stub_exact`
// samples a point from a Gaussian and takes its direction, with the exact density of such
// directions. `stub_projected` projects points on the plane through the mean (Schuessler et al.
// 2022, sec. 5.2).

#include <cmath>

#include <pharos/config/registry.h>
#include <pharos/core/warp.h>
#include <pharos/guiding/contract/guider.h>
#include <pharos/guiding/contract/spatial_mixture.h>

#include "stubs.h"

namespace pharos::stubs {
namespace {

double normal_pdf(double x) {
  return std::exp(-0.5 * x * x) / std::sqrt(2 * double{kPi});
}

Vec3 lower_solve(const float* l, Vec3 v) {
  const float x = v.x / l[0];
  const float y = (v.y - l[1] * x) / l[2];
  return {x, y, (v.z - l[3] * x - l[4] * y) / l[5]};
}

Vec3 normal_3d(const VertexStream& stream) {
  const Vec2 u = stream.get_2d(Purpose::guide_direction);
  const float w = stream.get_1d(Purpose::guide_distance);
  const auto gauss = [](float v) {
    return static_cast<float>(warp::normal_from_unit(v + 0x1p-25));
  };
  return {gauss(u.x), gauss(u.y), gauss(w)};
}

/// Directions to points of a 3D Gaussian about `mean` (relative to the origin). The density is p0
/// of Lelyakin et al. 2025 in whitened coordinates.
struct Exact {
  static std::optional<Vec3> sample(const SpatialGaussian& g, Vec3 mean,
                                    const VertexStream& stream) {
    const Vec3 point = mean + spread(g, normal_3d(stream));
    if (length_squared(point) == 0) return std::nullopt;
    return normalize(point);
  }
  static double pdf(const SpatialGaussian& g, Vec3 mean, Vec3 direction) {
    const Vec3 v = lower_solve(g.cholesky, direction);
    const Vec3 m = lower_solve(g.cholesky, mean);
    const double a = length_squared(v);
    const double u = dot(v, m) / std::sqrt(a);
    const double e = -length_squared(cross(v, m)) / (2 * a);
    const double determinant = double{g.cholesky[0]} * g.cholesky[2] * g.cholesky[5];
    const double scale = std::exp(e) / (2 * double{kPi} * determinant * std::pow(a, 1.5));
    const double cumulative = 0.5 * std::erfc(-u / std::sqrt(2.0));
    return scale * ((1 + u * u) * cumulative + u * normal_pdf(u));
  }
};

/// Directions to points of a 3D Gaussian that are projected on a plane. The plane contains the mean
/// and is perpendicular to the direction to the mean.
struct Projected {
  static std::optional<Vec3> sample(const SpatialGaussian& g, Vec3 mean,
                                    const VertexStream& stream) {
    if (length_squared(mean) == 0) return std::nullopt;
    const Vec3 n = normalize(mean), point = spread(g, normal_3d(stream));
    return normalize(mean + point - dot(n, point) * n);
  }
  static double pdf(const SpatialGaussian& g, Vec3 mean, Vec3 direction) {
    const float d = length(mean);
    if (d == 0) return 0;
    const float cosine = dot(mean / d, direction);
    if (cosine <= 0) return 0;
    // In whitened space, only the offset perpendicular to the whitened line of sight counts in the
    // plane.
    const Vec3 white = lower_solve(g.cholesky, d / cosine * direction - mean);
    const Vec3 line = lower_solve(g.cholesky, mean);
    const double squared = length_squared(cross(white, line)) / length_squared(line);
    const double determinant = root_determinant(g) * length(line) / d;
    return std::exp(-0.5 * squared) * d * d /
           (2 * double{kPi} * determinant * std::pow(double{cosine}, 3.0));
  }
};

template <class Way>
class MixtureDistribution final : public GuidingDistribution {
 public:
  MixtureDistribution(std::span<const SpatialGaussian> components, Point3 origin)
      : components_(components), origin_(origin) {}

  std::optional<Proposal> propose(const VertexStream& stream) const override {
    float u = stream.get_1d(Purpose::guide_choice);
    std::size_t k = 0;
    while (k + 1 < components_.size() && u >= components_[k].weight) u -= components_[k++].weight;
    const SpatialGaussian& g = components_[k];
    const std::optional<Vec3> direction = Way::sample(g, g.mean - origin_, stream);
    if (!direction) return std::nullopt;
    return Proposal{.direction = *direction};
  }
  float density(const ResolvedVertex& vertex) const override {
    double sum = 0;
    for (const SpatialGaussian& g : components_) {
      sum += g.weight * Way::pdf(g, g.mean - origin_, vertex.direction);
    }
    return static_cast<float>(sum);
  }

 private:
  std::span<const SpatialGaussian> components_;
  Point3 origin_;
};

template <class Way>
class MixtureGuider final : public GuiderOf<SpatialMixture> {
 public:
  using Settings = NoSettings;
  explicit MixtureGuider(Settings) {}
  GuiderTraits traits() const override { return {}; }
  const GuidingDistribution* query(const SpatialMixture& model, const GuidingQuery& query,
                                   Arena& arena) const override {
    const std::span<const SpatialGaussian> components = model.mixture_at(query, arena);
    if (components.empty()) return nullptr;
    return arena.make<MixtureDistribution<Way>>(components, query.current.position);
  }
};

}  // namespace

void register_mixture_guiders(Registry& registry) {
  registry.add<MixtureGuider<Exact>>("stub_exact", "Directions to points of the Gaussians");
  registry.add<MixtureGuider<Projected>>("stub_projected", "Points in planes through the means");
}

}  // namespace pharos::stubs
