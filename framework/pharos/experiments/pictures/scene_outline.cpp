#include <algorithm>
#include <cmath>

#include <pharos/core/parallel.h>
#include <pharos/experiments/pictures/scene_outline.h>

namespace pharos {
namespace {

/// The width of the lines [pixels].
constexpr float kLineWidth = 2;

/// A line of pixels in the slice, along a row or a column.
struct PixelLine {
  Ray ray;          ///< along the line, from one pixel before the first
  int count;        ///< number of pixels
  float pixel;      ///< length of a pixel along the line [scene units]
  float* first;     ///< coverage of the first pixel
  std::size_t gap;  ///< stride between the coverages of neighboring pixels

  /// Covers the pixels near `position` [pixels from the beginning of the first pixel].
  void mark(float position) const {
    const int nearest = static_cast<int>(std::floor(position));
    for (int i = std::max(nearest - 1, 0); i <= std::min(nearest + 1, count - 1); ++i) {
      const float distance = std::abs(static_cast<float>(i) + 0.5f - position);
      const float covered = std::clamp((kLineWidth + 1) / 2 - distance, 0.0f, 1.0f);
      float& coverage = first[static_cast<std::size_t>(i) * gap];
      coverage = std::max(coverage, covered);
    }
  }

  /// Marks all surfaces on the line, traced from its beginning or from its end.
  void mark_surfaces(const Scene& scene, bool from_the_end) const {
    const float length = static_cast<float>(count + 2);
    const Vec3 way = pixel * ray.direction;
    SurfacePoint hit;
    float done = 0;
    while (done < length) {
      const float from_beginning = from_the_end ? length - done : done;
      const Ray rest{ray.origin + from_beginning * way,
                     from_the_end ? -ray.direction : ray.direction, (length - done) * pixel};
      const float distance = scene.intersect(rest, hit);
      if (distance == kInfinity) return;
      done += distance / pixel;
      mark((from_the_end ? length - done : done) - 1);
      done += 0.5f;
    }
  }
};

PixelLine row_of(const SlicePlane& plane, int y, Image& image) {
  const float pixel = length(plane.right) / static_cast<float>(plane.width);
  const Vec3 along = normalize(plane.right);
  const float v = (static_cast<float>(y) + 0.5f) / static_cast<float>(plane.height);
  return {{plane.at(0, v) - pixel * along, along}, plane.width, pixel, image.pixel(0, y), 1};
}

PixelLine column_of(const SlicePlane& plane, int x, Image& image) {
  const float pixel = length(plane.down) / static_cast<float>(plane.height);
  const Vec3 along = normalize(plane.down);
  const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(plane.width);
  return {{plane.at(u, 0) - pixel * along, along},
          plane.height,
          pixel,
          image.pixel(x, 0),
          static_cast<std::size_t>(plane.width)};
}

}  // namespace

Image scene_outline(const Scene& scene, const SlicePlane& plane) {
  Image image(plane.width, plane.height, {"Y"});
  if (length(plane.right) == 0 || length(plane.down) == 0)
    return image;  // the slice is only a line
  const auto mark = [&](const PixelLine& line) {
    line.mark_surfaces(scene, false);
    line.mark_surfaces(scene, true);
  };
  // Columns run after rows, because both mark the same pixels.
  parallel_for(static_cast<std::size_t>(plane.height),
               [&](std::size_t y) { mark(row_of(plane, static_cast<int>(y), image)); });
  parallel_for(static_cast<std::size_t>(plane.width),
               [&](std::size_t x) { mark(column_of(plane, static_cast<int>(x), image)); });
  return image;
}

void draw_over(Image& colors, const Image& coverage) {
  parallel_for(static_cast<std::size_t>(colors.height()), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < colors.width(); ++x) {
      const float covered = *coverage.pixel(x, y);
      colors.set_rgb(x, y, (1 - covered) * colors.rgb(x, y) + covered * Rgb(1));
    }
  });
}

}  // namespace pharos
