#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pharos/core/image.h>
#include <pharos/experiments/pictures/density_slice.h>
#include <pharos/guiding/contract/mixing.h>

namespace pharos {

/// The mixing of methods as a render has learned it.
struct LearnedMixing {
  /// A method's model, and the number of the model's first region in the common numbering.
  struct Method {
    std::shared_ptr<const GuidingModel> model;
    std::uint32_t first_region = 0;
  };
  std::shared_ptr<const MixingShares> shares;
  std::vector<Method> methods;
};

/// A surface vertex without a place.
struct ShownVertex {
  float roughness = 1;
  std::uint16_t bounce = 1;  ///< number of the vertex; the first one after the lens is 1
};

/// Returns the shares of unguided sampling and of every method at a vertex at `position`. If no
/// model knows the place, unguided sampling has the share 1.
std::vector<float> shares_at(const LearnedMixing& mixing, Point3 position,
                             const ShownVertex& vertex);

/// The distance between the panels of share_slices() [pixels].
inline constexpr int kPanelGap = 4;

/// Returns shares_at() on a plane in one channel "Y": one column of panels for each technique,
/// unguided sampling first, and one row for each kind of vertex. The gaps between panels are NaN.
Image share_slices(const LearnedMixing& mixing, const SlicePlane& plane,
                   const std::vector<ShownVertex>& vertices);

/// Returns mean shares on a grid of places in `bounds` where some model knows something; an empty
/// list if there is no such place.
std::vector<float> mean_shares(const LearnedMixing& mixing, const Bounds3& bounds,
                               const ShownVertex& vertex);

}  // namespace pharos
