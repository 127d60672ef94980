#pragma once

#include <vector>

#include <pharos/core/vec.h>

/// Curves in the half-plane of distance from the axis (x) and height (y), which a lathe turns.
namespace pharos {

/// One straight piece of a profile, turned into a band of triangles.
struct ProfilePiece {
  Vec2 from, to;
  Vec2 normal_from, normal_to;  ///< unit; on the right of the way from `from` to `to`
  float v_from = 0, v_to = 0;   ///< arc length from the profile's start, as a fraction of the whole
};

/// Throws InputError, saying which point is to blame, unless there are two points, none has a
/// negative distance, none repeats the one before, and a closed profile has three corners.
void check_profile(const std::vector<Vec2>& points);

/// The Catmull-Rom spline through all points, as `subdivisions` straight pieces for each pair of
/// neighbors. In centripetal form it has no cusps or loops between neighbors (Yuksel, Schaefer
/// and Keyser 2011, "Parameterization and Applications of Catmull-Rom Curves"). Closed profiles
/// stay smooth at the seam, and ends on the axis meet it at a right angle. Distances that would be
/// negative become zero.
std::vector<Vec2> catmull_rom(const std::vector<Vec2>& points, int subdivisions);

/// The pieces between neighboring points but for those along the axis, which have no area. Where
/// pieces meet at an angle of at most `crease` [degrees] their normals agree; on the axis a
/// piece's neighbor is its own mirror image.
std::vector<ProfilePiece> profile_pieces(const std::vector<Vec2>& points, float crease);

}  // namespace pharos
