#pragma once

#include <array>
#include <string_view>
#include <utility>

#include <pharos/config/schema.h>
#include <pharos/core/warp.h>

namespace pharos {

/// The map by which matt BSDFs turn two random numbers into a direction.
enum class HemisphereWarp {
  concentric,  ///< density proportional to the cosine: all samples of ideally matt surfaces have
               ///< equal weight
  octahedral   ///< keeps straight edges straight, for samplers that align with them
};

template <>
struct EnumNames<HemisphereWarp> {
  static constexpr auto names = std::to_array<EnumName<HemisphereWarp>>(
      {{"concentric", HemisphereWarp::concentric}, {"octahedral", HemisphereWarp::octahedral}});
};

/// Declares the parameter `warp` for settings with a member of this name.
template <class Settings>
void describe_warp(Schema<Settings>& s) {
  s.field("warp", &Settings::warp,
          "Map from random numbers to directions: concentric follows the cosine, octahedral keeps "
          "edges straight");
}

/// Maps a point of [0, 1)^2 to a direction of the hemisphere about +z.
inline Vec3 hemisphere_from_square(HemisphereWarp kind, Vec2 u) {
  return kind == HemisphereWarp::octahedral ? warp::octahedral_hemisphere_from_square(u)
                                            : warp::cosine_hemisphere_from_square(u);
}

/// The density of hemisphere_from_square() [1/sr]; 0 below the horizon.
inline float hemisphere_pdf(HemisphereWarp kind, Vec3 direction) {
  return kind == HemisphereWarp::octahedral ? warp::octahedral_hemisphere_pdf(direction)
                                            : warp::cosine_hemisphere_pdf(direction.z);
}

}  // namespace pharos
