#pragma once

#include <vector>

#include <pharos/config/schema.h>

#include "triangle_shape.h"

namespace pharos {

/// The interpolation between the points of a lathe's profile.
enum class ProfileInterpolation { linear, catmull_rom };
template <>
struct EnumNames<ProfileInterpolation> {
  static constexpr auto names = std::to_array<EnumName<ProfileInterpolation>>(
      {{"linear", ProfileInterpolation::linear},
       {"catmull_rom", ProfileInterpolation::catmull_rom}});
};

/// See lathe.cpp.
class Lathe : public TriangleShape {
 public:
  struct Settings {
    std::vector<Vec2> profile = {};
    int segments = 64;
    ProfileInterpolation interpolation = ProfileInterpolation::linear;
    int subdivisions = 8;
    bool smooth = true;
    float crease = 30;
    Transform to_world = {};
    bool flip_normals = false;
    static void describe(Schema<Settings>& s);
  };

  /// Throws InputError if the profile encloses no surface.
  explicit Lathe(const Settings& settings);

  /// For smooth lathes, du has the direction of the circle instead of the facet, in accordance with
  /// the normals.
  UvTangents uv_tangents(const SurfacePoint& point) const override;

 private:
  Transform to_world_;
  bool smooth_;
};

}  // namespace pharos
