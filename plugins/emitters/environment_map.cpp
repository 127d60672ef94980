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

#include "latlong_light.h"

namespace pharos {

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
      axes_(turned_axes(settings.to_world, "environment_map")),
      scale_(settings.scale) {}

std::unique_ptr<const Light> EnvironmentMap::place(const EmitterSite& site) const {
  return latlong_light(image_, distribution_, axes_, scale_, site);
}

}  // namespace pharos
