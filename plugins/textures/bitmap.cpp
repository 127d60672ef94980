// bitmap: an image file stretched over the unit square of texture coordinates, with (0, 0) at the
// lower left corner of the picture and (1, 1) at the upper right. Texel centers lie half a texel
// inside. The color comes from the channels R, G, B or else Y, in any order. If there are no
// channels of these names, it comes from the first three channels, or from the first one alone if
// there are fewer than three.
//
//     { type: bitmap, file: wood.png, filter: bilinear, wrap: repeat, uv_scale: [2, 2] }
#include "bitmap.h"

namespace pharos {

void Bitmap::Settings::describe(Schema<Settings>& s) {
  s.field("file", &Settings::file, "Image file").required();
  s.field("filter", &Settings::filter, "Interpolation between texels");
  s.field("wrap", &Settings::wrap, "How the image continues outside the unit square");
  s.field("color_space", &Settings::color_space, "Encoding of 8- and 16-bit images");
  s.field("uv_scale", &Settings::uv_scale, "Factors on the texture coordinates");
  s.example("{ file: example.png }");
  s.example("{ file: example.png, filter: nearest, wrap: mirror, uv_scale: [3, 0.5] }");
  s.example("{ file: example.exr, wrap: clamp }");
}

Bitmap::Bitmap(const Settings& settings) : settings_(settings) {
  texels_ = read_colors(settings.file, settings.color_space);
  check_colors(texels_, settings.file);
  double sums[3] = {};
  for (int y = 0; y < texels_.height(); ++y) {
    for (int x = 0; x < texels_.width(); ++x) {
      const Rgb c = texels_.pixel(x, y);
      maximum_ = max(maximum_, c);
      for (int i = 0; i < 3; ++i) sums[i] += double{c[i]};
    }
  }
  const double n = double{1} * texels_.width() * texels_.height();
  for (int i = 0; i < 3; ++i) average_[i] = static_cast<float>(sums[i] / n);
}

Rgb Bitmap::value_at(const SurfacePoint& point) const {
  const float u = wrapped(point.uv.x * settings_.uv_scale.x);
  const float v = wrapped(point.uv.y * settings_.uv_scale.y);
  const float x = u * static_cast<float>(texels_.width()),
              y = (1 - v) * static_cast<float>(texels_.height());
  return settings_.filter == BitmapFilter::nearest ? nearest(x, y) : bilinear(x, y);
}

/// Maps any coordinate to the coordinate in [0, 1] whose color it has.
float Bitmap::wrapped(float coordinate) const {
  switch (settings_.wrap) {
    case BitmapWrap::repeat:
      return coordinate - std::floor(coordinate);
    case BitmapWrap::mirror: {
      const float t = coordinate - 2 * std::floor(0.5f * coordinate);
      return t > 1 ? 2 - t : t;
    }
    case BitmapWrap::clamp:
      break;
  }
  return std::clamp(coordinate, 0.0f, 1.0f);
}

/// Maps an index that is at most one outside the image to a texel's index.
int Bitmap::neighbor(int index, int size) const {
  if (settings_.wrap == BitmapWrap::repeat) return index < 0 ? size - 1 : index < size ? index : 0;
  return std::clamp(index, 0, size - 1);
}

Rgb Bitmap::nearest(float x, float y) const {
  return texels_.pixel(std::min(static_cast<int>(x), texels_.width() - 1),
                       std::min(static_cast<int>(y), texels_.height() - 1));
}

Rgb Bitmap::bilinear(float x, float y) const {
  const float left = std::floor(x - 0.5f), top = std::floor(y - 0.5f);
  const float a = x - 0.5f - left, b = y - 0.5f - top;
  const int x0 = neighbor(static_cast<int>(left), texels_.width());
  const int x1 = neighbor(static_cast<int>(left) + 1, texels_.width());
  const int y0 = neighbor(static_cast<int>(top), texels_.height());
  const int y1 = neighbor(static_cast<int>(top) + 1, texels_.height());
  return (1 - b) * ((1 - a) * texels_.pixel(x0, y0) + a * texels_.pixel(x1, y0)) +
         b * ((1 - a) * texels_.pixel(x0, y1) + a * texels_.pixel(x1, y1));
}

}  // namespace pharos
