#pragma once

#include <array>
#include <string_view>
#include <utility>

#include <pharos/config/schema.h>
#include <pharos/core/warp.h>

namespace pharos {

/// How matt BSDFs make a direction of two numbers.
enum class HemisphereWarp {
  concentric,  ///< in proportion to the cosine: samples of ideally matt surfaces weigh the same
  octahedral   ///< straight edges stay straight in the numbers, for samplers that align with them
};

template <>
struct EnumNames<HemisphereWarp> {
  static constexpr std::array<std::pair<std::string_view, HemisphereWarp>, 2> names{
      {{"concentric", HemisphereWarp::concentric}, {"octahedral", HemisphereWarp::octahedral}}};
};

/// Declares `warp`, for settings with a member of this name.
template <class Settings>
void describe_warp(Schema<Settings>& s) {
  s.field("warp", &Settings::warp,
          "Map from the square to directions: in proportion to the cosine, or one that keeps edges "
          "straight");
}

/// A direction of the hemisphere about +z for numbers in [0, 1)^2.
inline Vec3 hemisphere_from_square(HemisphereWarp kind, Vec2 u) {
  return kind == HemisphereWarp::octahedral ? warp::octahedral_hemisphere_from_square(u)
                                            : warp::cosine_hemisphere_from_square(u);
}

/// Its density [1/sr]; 0 below the horizon.
inline float hemisphere_pdf(HemisphereWarp kind, Vec3 direction) {
  return kind == HemisphereWarp::octahedral ? warp::octahedral_hemisphere_pdf(direction)
                                            : warp::cosine_hemisphere_pdf(direction.z);
}

}  // namespace pharos
