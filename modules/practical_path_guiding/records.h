#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include <pharos/config/values.h>
#include <pharos/guiding/record/path_record.h>
#include <pharos/guiding/toolkit/guidable_steps.h>
#include <pharos/guiding/toolkit/pixel_estimates.h>

namespace pharos {
namespace practical_path_guiding {

/// The quantity that the sampling density is proportional to.
enum class GuidingTarget {
  radiance,  ///< incident radiance (Mueller et al. 2017)
  /// the root of the second moment of reflected radiance (`simple` in Rath et al. 2020)
  product,
  /// the root of the second moment of the contribution to the pixel, relative to the pixel's value
  /// (`full` in Rath et al. 2020)
  relative
};

/// A step of a path: its position, its direction, and its value in the leaf of this direction.
struct Record {
  Point3 position;
  Vec2 direction;            ///< point on the square by warp::square_from_sphere()
  std::uint32_t facing = 0;  ///< facing_of() the surface
  /// x / p for `radiance`, x^2 / p for the other targets, where p [1/sr] is the density of the
  /// direction; 0 if no light arrived
  float value = 0;
  /// Number of steps for which it stands (RecordedVertex::continuation): more than 1 if it has
  /// survived Russian roulette, less if the path has split
  float steps = 1;
  void archive(Archive& archive);
};

/// Appends the guidable steps of a path. The target `relative` uses `pixels`. `incident` is scratch
/// memory.
void extract_records(const PathView& path, GuidingTarget target, LightHits hits,
                     const PixelEstimates& pixels, std::vector<Rgb>& incident,
                     std::vector<Record>& records);

}  // namespace practical_path_guiding

template <>
struct EnumNames<practical_path_guiding::GuidingTarget> {
  static constexpr auto names = std::to_array<EnumName<practical_path_guiding::GuidingTarget>>(
      {{"radiance", practical_path_guiding::GuidingTarget::radiance},
       {"product", practical_path_guiding::GuidingTarget::product},
       {"relative", practical_path_guiding::GuidingTarget::relative}});
};

}  // namespace pharos
