// environment_map: radiance from infinitely far away, by direction, from an image in
// latitude-longitude layout (equirectangular). In the map's own space +y is up: the top row of
// the image is what is seen looking along +y, the bottom row along -y. A direction d meets the
// image at
//
//     u = atan2(d.x, -d.z) / (2 pi)    from the left edge, which is seen along -z, as a share
//     v = acos(d.y) / pi               from the top edge
//
// so that the middle of the image is seen along +z and columns go on to the right of it along -x,
// as in Mitsuba 0.6. The image covers the whole sphere, whatever its shape: pixels are as wide as
// high at the horizon if it is 2:1, and any other ratio is stretched. Scenes where +z is up turn it
// by 90 degrees about x. Radiance is bilinear between the pixels' centres, around in u and up to
// the edge in v, times `scale`. Files of 8 and 16 bit are taken as sRGB.
//
// Sampled in proportion to radiance, nearly: the density is bilinear between the pixels' means of
// channels, so that nothing that shines is missed. It is inverted in latitude first, then along the
// row, and the map from primary numbers to directions is continuous where the image shines.
//
//     emitters:
//       - { type: environment_map, file: sky.exr, scale: 2,
//           to_world: { rotate: { axis: [1, 0, 0], degrees: 90 } } }

#include "environment_map.h"

#include <algorithm>

#include <pharos/core/error.h>

#include "distant_light.h"

namespace pharos {
namespace {

/// The unit images of the three axes under a map that turns, mirrors and scales evenly; the scale
/// says nothing about directions.
Frame turned_axes(const Transform& map) {
  const Vec3 x = map.vector({1, 0, 0}), y = map.vector({0, 1, 0}), z = map.vector({0, 0, 1});
  const Frame axes{normalize(x), normalize(y), normalize(z)};
  constexpr float kTolerance = 1e-4f;  // products of rotations in float stay well below
  const float skew =
      std::max({abs_dot(axes.s, axes.t), abs_dot(axes.t, axes.n), abs_dot(axes.n, axes.s)});
  const auto [shortest, longest] = std::minmax({length(x), length(y), length(z)});
  if (!(skew < kTolerance && longest - shortest < kTolerance * longest)) {
    throw InputError("environment_map: 'to_world' must scale evenly and not shear");
  }
  return axes;
}

class EnvironmentLight final : public Light {
 public:
  EnvironmentLight(const LatLongImage& image, const LatLongDistribution& distribution,
                   const Frame& axes, float scale, const EmitterSite& site)
      : image_(image), distribution_(distribution), axes_(axes), scale_(scale), site_(site) {}

  LightSample sample(Point3 from, Vec2 u) const override {
    const std::optional<Vec3> local = distribution_.sample(u);
    if (!local) return {};
    // Asked again, so that value and density are to the last bit those of a ray that leaves the
    // scene this way.
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

  float power() const override {
    return power_into_scene(site_, scale_ * distribution_.integral());
  }

 private:
  const LatLongImage& image_;
  const LatLongDistribution& distribution_;
  Frame axes_;  ///< of the map's space, in the world; left-handed when to_world mirrors
  float scale_;
  EmitterSite site_;
};

}  // namespace

void EnvironmentMap::Settings::describe(Schema<Settings>& s) {
  s.field("file", &Settings::file, "Image in latitude-longitude layout").required();
  s.field("to_world", &Settings::to_world,
          "From the map's space, where +y is up, to world space; no shear, even scale");
  s.field("scale", &Settings::scale, "Factor on the radiance").at_least(0);
  s.example("{ file: example.exr }");
  s.example(
      "{ file: example.exr, scale: 3, to_world: { rotate: { axis: [1, 2, 0.5], degrees: 70 } } }");
}

EnvironmentMap::EnvironmentMap(const Settings& settings)
    : image_(settings.file),
      distribution_(image_),
      axes_(turned_axes(settings.to_world)),
      scale_(settings.scale) {}

std::unique_ptr<const Light> EnvironmentMap::place(const EmitterSite& site) const {
  return std::make_unique<const EnvironmentLight>(image_, distribution_, axes_, scale_, site);
}

}  // namespace pharos
