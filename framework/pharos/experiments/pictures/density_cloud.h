#pragma once

#include <functional>

#include <pharos/core/bounds.h>
#include <pharos/core/image.h>
#include <pharos/experiments/pictures/color_map.h>
#include <pharos/guiding/contract/model.h>
#include <pharos/scene/scene.h>

namespace pharos {

/// A view of space: a ray for every position (u, v) in (0,1)^2 of a picture, counted from its left
/// upper corner.
struct CloudView {
  int width, height;  ///< [pixels]
  std::function<Ray(float u, float v)> ray;
};

/// What the scene's camera sees of a film of this shape, the longer edge `size` pixels; the scene
/// must outlive it.
CloudView camera_view(const Scene& scene, int film_width, int film_height, int size);

/// All of `bounds` seen from afar, from the front, the right and above (y is up), without
/// perspective, in a square of `size` pixels.
CloudView oblique_view(const Bounds3& bounds, int size);

/// The largest density along each ray within `bounds`, as far as equal steps of at most a
/// `size`-th of their diagonal find it, `size` being the longer edge of the picture; what is behind
/// surfaces counts too. One channel, "Y".
Image cloud_density(const GuidingModel& model, const Bounds3& bounds, const CloudView& view);

/// The scene's surfaces in shades of gray, brightest where they face the viewer: three channels,
/// linear.
Image shaded_scene(const Scene& scene, const CloudView& view);

/// The edges of `bounds` in oblique_view() of the same size, as gray lines: three channels, linear.
Image box_edges(const Bounds3& bounds, int size);

/// Lays the cloud over `backdrop`: the brighter on the scale, the less shines through.
Image cloud_picture(const Image& density, const ColorScale& scale, const Image& backdrop);

}  // namespace pharos
