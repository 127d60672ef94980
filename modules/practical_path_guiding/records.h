#pragma once

#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include <pharos/config/values.h>
#include <pharos/guiding/record/path_record.h>

#include "pixel_estimates.h"

namespace pharos {
namespace practical_path_guiding {

/// What directions are to be sampled in proportion to.
enum class GuidingTarget {
  radiance,  ///< the radiance that comes from there (Mueller et al. 2017)
  /// the root of the second moment of what is reflected of it (Rath et al. 2020, their `simple`)
  product,
  /// the root of the second moment of what it adds to the pixel, relative to the pixel's value
  /// (Rath et al. 2020, their `full`)
  relative
};

/// A step of a path: where, whither, and what it counts in the leaf of its direction.
struct Record {
  Point3 position;
  Vec2 direction;   ///< on the square, as warp::square_from_sphere()
  float value = 0;  ///< x / p for `radiance`, x^2 / p for the others, p [1/sr] being the density of
                    ///< the direction; 0 where nothing came
  void archive(Archive& archive);
};

/// Appends the guidable steps of a path. `pixels` is what `relative` needs.
void extract_records(const PathView& path, GuidingTarget target, const PixelEstimates& pixels,
                     std::vector<Rgb>& incident, std::vector<Record>& records);

}  // namespace practical_path_guiding

template <>
struct EnumNames<practical_path_guiding::GuidingTarget> {
  static constexpr auto names =
      std::to_array<EnumName<practical_path_guiding::GuidingTarget>>({{"radiance", practical_path_guiding::GuidingTarget::radiance},
             {"product", practical_path_guiding::GuidingTarget::product},
             {"relative", practical_path_guiding::GuidingTarget::relative}});
};

}  // namespace pharos
