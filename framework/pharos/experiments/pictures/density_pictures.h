#pragma once

#include <string>
#include <vector>

#include <pharos/core/image.h>
#include <pharos/guiding/contract/model.h>
#include <pharos/scene/scene.h>

namespace pharos {

/// A picture of a learned density in one channel "Y", up to a constant factor.
struct DensityPicture {
  std::string name;  ///< such as "slice-z"; part of a file name
  std::string caption;
  Image image;
};

/// Returns slices of the density through the center of the scene's bounds, viewed along x, y and z.
/// If there is a surface in the middle of a picture of `width` x `height` pixels, also returns the
/// density over directions at this surface (latitude-longitude, +y up).
std::vector<DensityPicture> density_pictures(const GuidingModel& model, const Scene& scene,
                                             int width, int height);

}  // namespace pharos
