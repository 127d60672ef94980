// sky: the light of the clear sky without the sun's disk. Closed formulas give the radiance from
// the turbidity of the air, the height of the sun, and the angles to sun and zenith. Together with
// a `sun` of the same parameters it makes daylight.
//
// - `hosek_wilkie`: Hosek and Wilkie 2012 ("An Analytic Model for Full Spectral Sky-Dome
//   Radiance"), fitted to simulated skies. Light that the ground reflects into the sky depends on
//   `ground`, not on the ground of the scene. Mitsuba 0.6 and 3 use this model.
// - `preetham`: Preetham, Shirley and Smits 1999 ("A Practical Analytic Model for Daylight"). It
//   was fitted for turbidities from 2 to 6. Below 2 its horizon is far too bright. The fit includes
//   light from a ground.
//
// The sun stands at `sun_direction`, or where an `observer` at a place and time sees it (to half a
// minute of arc, without refraction). Daylight saving time must be included in the timezone. In the
// sky's own space +y is up, +x east and -z north; to_world maps it to the world. A sun below the
// horizon is an error. Below the horizon the sky is black. `stretch` is a factor on all angles from
// the zenith that lowers the horizon, for scenes whose ground ends too soon.
//
// Radiance is spectral radiance in W/(m^2 sr nm), as in Mitsuba 0.6: a mean over wavelength,
// weighted by the matching functions. A luminance Y in Rec.709 therefore means 72984 Y cd/m^2.
//
// The sky is evaluated at the pixels of an image of the sphere, `resolution` pixels wide and half
// as high. From then on it behaves like the `environment_map` of this image.
//
//     emitters:
//       - { type: sky, turbidity: 3, sun_direction: [1, 0, 1],
//           to_world: { rotate: { axis: [1, 0, 0], degrees: 90 } } }

#include "sky.h"

#include <cmath>
#include <numbers>

#include "hosek_wilkie.h"
#include "latlong_light.h"
#include "preetham.h"

namespace pharos {
namespace {

/// Makes the image of a sky with `radiance(zenith, gamma)`.
template <class Sky>
LatLongImage sky_image(const Sky& sky, const SkyEmitter::Settings& settings, const SunPlace& sun) {
  const int width = settings.resolution, height = width / 2;
  std::vector<Rgb> pixels;
  pixels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int row = 0; row < height; ++row) {
    const double zenith = std::numbers::pi * (row + 0.5) / height / settings.stretch;
    for (int column = 0; column < width; ++column) {
      const double azimuth = 2 * std::numbers::pi * (column + 0.5) / width;
      const double cosine =
          std::cos(zenith) * std::cos(sun.zenith) +
          std::sin(zenith) * std::sin(sun.zenith) * std::cos(azimuth - sun.azimuth);
      pixels.push_back(2 * zenith < std::numbers::pi
                           ? sky.radiance(zenith, std::acos(std::clamp(cosine, -1.0, 1.0)))
                           : Rgb());
    }
  }
  return {width, height, std::move(pixels)};
}

LatLongImage sky_image(const SkyEmitter::Settings& settings, const SunPlace& sun) {
  if (settings.model == SkyModel::preetham) {
    return sky_image(PreethamSky(settings.turbidity, sun.zenith), settings, sun);
  }
  const HosekWilkieSky sky(settings.turbidity, settings.ground, sun.zenith);
  return sky_image(sky, settings, sun);
}

}  // namespace

void SkyEmitter::Settings::describe(Schema<Settings>& s) {
  describe_daylight(s);
  s.field("model", &Settings::model, "Formula for the radiance");
  s.field("ground", &Settings::ground,
          "Reflectance of the ground that lights the sky, for `hosek_wilkie`")
      .at_least(0)
      .at_most(1);
  s.field("resolution", &Settings::resolution, "Width of the image that stores the sky; even")
      .unit("pixels")
      .at_least(8)
      .at_most(8192)
      .check("even", [](int width) { return width % 2 == 0; });
  s.example("{ turbidity: 2, sun_direction: [1, 1, 0], ground: [0.2, 0.4, 0.1] }");
  s.example(
      "{ model: preetham, turbidity: 6, sun_direction: [1, 0, 0.1], stretch: 1.2, resolution: 64, "
      "scale: 3, "
      "to_world: { rotate: { axis: [1, 0, 0], degrees: 90 } } }");
  s.example("{ observer: { latitude: 52.5, longitude: 13.4, timezone: 1, month: 12, hour: 10 } }");
}

SkyEmitter::SkyEmitter(const Settings& settings)
    : axes_(turned_axes(settings.to_world, "sky")),
      image_(sky_image(settings, sun_place(settings, axes_, "sky"))),
      distribution_(image_),
      scale_(settings.scale) {}

std::unique_ptr<const Light> SkyEmitter::place(const EmitterSite& site) const {
  return latlong_light(image_, distribution_, axes_, scale_, site);
}

}  // namespace pharos
