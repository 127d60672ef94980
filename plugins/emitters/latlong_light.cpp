#include "latlong_light.h"

#include <algorithm>

#include <fmt/core.h>

#include <pharos/core/error.h>

#include "distant_light.h"

namespace pharos {
namespace {

class LatLongLight final : public Light {
 public:
  LatLongLight(const LatLongImage& image, const LatLongDistribution& distribution,
               const Frame& axes, float scale, const EmitterSite& site)
      : image_(image), distribution_(distribution), axes_(axes), scale_(scale), site_(site) {}

  LightSample sample(Point3 from, Vec2 u) const override {
    const std::optional<Vec3> local = distribution_.sample(u);
    if (!local) return {};
    // Value and density are evaluated for the rounded direction, so that they match to the last bit
    // the values for a ray that leaves the scene in this direction.
    const Vec3 direction = axes_.to_world(*local);
    const LatLong place = LatLong::of(axes_.to_local(direction));
    return distant_sample(site_, from, direction, scale_ * image_.evaluate(place),
                          distribution_.pdf(place));
  }

  bool is_environment() const override { return true; }
  float pdf_direction(Vec3 direction) const override {
    return distribution_.pdf(LatLong::of(axes_.to_local(direction)));
  }
  Rgb environment_radiance(Vec3 direction) const override {
    return scale_ * image_.evaluate(LatLong::of(axes_.to_local(direction)));
  }

  EmissionSample sample_emission(Vec2 u_position, Vec2 u_direction) const override {
    const std::optional<Vec3> local = distribution_.sample(u_direction);
    if (!local) return {.kind = VertexKind::environment};
    const Vec3 towards = axes_.to_world(*local);
    return distant_emission(site_, towards, environment_radiance(towards), pdf_direction(towards),
                            u_position);
  }
  EmissionDensity pdf_emission(const SurfacePoint&, Vec3 direction) const override {
    return {distant_position_pdf(site_), pdf_direction(-direction)};
  }

  float power() const override {
    return power_into_scene(site_, scale_ * distribution_.integral());
  }

 private:
  const LatLongImage& image_;
  const LatLongDistribution& distribution_;
  Frame axes_;  ///< axes of the map's space in the world; left-handed if to_world mirrors
  float scale_;
  EmitterSite site_;
};

}  // namespace

Frame turned_axes(const Transform& map, const char* emitter) {
  const Vec3 x = map.vector({1, 0, 0}), y = map.vector({0, 1, 0}), z = map.vector({0, 0, 1});
  const Frame axes{normalize(x), normalize(y), normalize(z)};
  constexpr float kTolerance = 1e-4f;  // products of rotations in float stay well below this
  const float skew =
      std::max({abs_dot(axes.s, axes.t), abs_dot(axes.t, axes.n), abs_dot(axes.n, axes.s)});
  const auto [shortest, longest] = std::minmax({length(x), length(y), length(z)});
  if (!(skew < kTolerance && longest - shortest < kTolerance * longest)) {
    throw InputError(fmt::format("{}: 'to_world' must scale evenly and not shear", emitter));
  }
  return axes;
}

std::unique_ptr<const Light> latlong_light(const LatLongImage& image,
                                           const LatLongDistribution& distribution,
                                           const Frame& axes, float scale,
                                           const EmitterSite& site) {
  return std::make_unique<const LatLongLight>(image, distribution, axes, scale, site);
}

}  // namespace pharos
