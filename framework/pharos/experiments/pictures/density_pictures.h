#pragma once

#include <string>
#include <vector>

#include <pharos/core/image.h>
#include <pharos/guiding/contract/model.h>
#include <pharos/scene/scene.h>

namespace pharos {

/// A picture of a learned density, one channel "Y", up to a constant factor.
struct DensityPicture {
  std::string name;  ///< such as "slice-z"; names a file
  std::string caption;
  Image image;
};

/// Slices of the density over the scene's bounds through their center, seen along x, y and z, and
/// the density over directions (latitude-longitude, +y up) at the surface in the middle of a
/// picture of `width` x `height` pixels, where there is one.
std::vector<DensityPicture> density_pictures(const GuidingModel& model, const Scene& scene,
                                             int width, int height);

}  // namespace pharos
