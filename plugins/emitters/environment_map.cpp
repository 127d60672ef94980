// environment_map: radiance from infinitely far away, given by direction in an image of
// latitude-longitude layout (equirectangular). In the map's own space +y is up: the top row of the
// image lies along +y, the bottom row along -y. A direction d meets the image at
//
//     u = atan2(d.x, -d.z) / (2 pi)    share of the width from the left edge, which lies along -z
//     v = acos(d.y) / pi               share of the height from the top edge
//
// The middle of the image therefore lies along +z, and the columns to its right continue towards
// -x, as in Mitsuba 0.6. The image covers the whole sphere for any aspect ratio. With 2:1 pixels at
// the horizon are as wide as high; any other ratio stretches them. For scenes where +z is up,
// rotate the map by 90 degrees about x. Radiance is bilinear between the pixels' centers, wraps
// around in u, is clamped at the edges in v, and is multiplied by `scale`. Files of 8 and 16 bits
// are read as sRGB.
//
// With `layout: equal_area`, the image is a square in which equal areas are equal solid angles
// (equal_area.h), as in pbrt-v4: its middle lies along +z of the map's space, its corners along -z,
// the middle of its right edge along +x and that of its lower edge along +y. It is converted to
// latitudes and longitudes with as many rows.
//
// Directions are sampled nearly in proportion to radiance. The density is bilinear between the
// means of the pixels' channels, so no direction with radiance is missed. It is inverted in
// latitude first, then along the row. The map from random numbers to directions is continuous
// wherever the image is not black.
//
//     emitters:
//       - { type: environment_map, file: sky.exr, scale: 2,
//           to_world: { rotate: { axis: [1, 0, 0], degrees: 90 } } }

#include "environment_map.h"

#include "equal_area.h"
#include "latlong_light.h"

namespace pharos {

void EnvironmentMap::Settings::describe(Schema<Settings>& s) {
  s.field("file", &Settings::file, "Image of all directions").required();
  s.field("to_world", &Settings::to_world,
          "Map from the image's space, where +y is up, to world space; even scale, no shear");
  s.field("scale", &Settings::scale, "Factor on the radiance").at_least(0);
  s.field("layout", &Settings::layout, "How the image shows the sphere of directions");
  s.example("{ file: example.exr }");
  s.example(
      "{ file: example.exr, scale: 3, to_world: { rotate: { axis: [1, 2, 0.5], degrees: 70 } } }");
}

EnvironmentMap::EnvironmentMap(const Settings& settings)
    : image_(settings.layout == EnvironmentLayout::equal_area ? read_equal_area(settings.file)
                                                              : LatLongImage(settings.file)),
      distribution_(image_),
      axes_(turned_axes(settings.to_world, "environment_map")),
      scale_(settings.scale) {}

std::unique_ptr<const Light> EnvironmentMap::place(const EmitterSite& site) const {
  return latlong_light(image_, distribution_, axes_, scale_, site);
}

}  // namespace pharos
