#pragma once

#include <functional>

#include <pharos/core/bounds.h>
#include <pharos/core/image.h>
#include <pharos/experiments/pictures/color_map.h>
#include <pharos/guiding/contract/model.h>
#include <pharos/scene/scene.h>

namespace pharos {

/// A view of space: a ray for every position (u, v) in (0,1)^2 of a picture. The position (0, 0) is
/// the upper left corner.
struct CloudView {
  int width, height;  ///< [pixels]
  std::function<Ray(float u, float v)> ray;
};

/// Returns the view of the scene's camera on a film of this shape. The longer edge has `size`
/// pixels. The scene must outlive the view.
CloudView camera_view(const Scene& scene, int film_width, int film_height, int size);

/// Returns a view of all of `bounds` from afar, from the front, the right and above (y is up),
/// without perspective, in a square of `size` pixels.
CloudView oblique_view(const Bounds3& bounds, int size);

/// Returns the largest density along each ray within `bounds`, in one channel "Y". It is searched
/// in equal steps of at most the diagonal of `bounds` divided by the longer edge of the picture
/// [pixels]. Densities behind surfaces count too.
Image cloud_density(const GuidingModel& model, const Bounds3& bounds, const CloudView& view);

/// Returns the scene's surfaces in shades of gray, brightest if they face the viewer: three
/// channels, linear.
Image shaded_scene(const Scene& scene, const CloudView& view);

/// Returns the edges of `bounds` as gray lines in the oblique_view() of the same size: three
/// channels, linear.
Image box_edges(const Bounds3& bounds, int size);

/// Draws the cloud over `backdrop`. The brighter the cloud is on the scale, the less of the
/// backdrop shines through.
Image cloud_picture(const Image& density, const ColorScale& scale, const Image& backdrop);

}  // namespace pharos
