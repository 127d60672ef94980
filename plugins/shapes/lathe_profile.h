#pragma once

#include <vector>

#include <pharos/core/vec.h>

/// Curves that a lathe turns, in the half-plane of distance from the axis (x) and height (y).
namespace pharos {

/// One straight piece of a profile, turned into a band of triangles.
struct ProfilePiece {
  Vec2 from, to;
  Vec2 normal_from, normal_to;  ///< unit; to the right of the direction from `from` to `to`
  float v_from = 0, v_to = 0;   ///< arc length from the profile's start, as a fraction of the whole
};

/// Throws InputError, naming the invalid point, unless there are two points, no point has a
/// negative distance, no point repeats its predecessor, and a closed profile has three corners.
void check_profile(const std::vector<Vec2>& points);

/// Returns the Catmull-Rom spline through all points, with `subdivisions` straight pieces for each
/// pair of neighbors. The centripetal form has no cusps or loops between neighbors (Yuksel,
/// Schaefer and Keyser 2011, "Parameterization and Applications of Catmull-Rom Curves"). Closed
/// profiles are smooth at the seam, and ends on the axis meet the axis at a right angle. Negative
/// distances become zero.
std::vector<Vec2> catmull_rom(const std::vector<Vec2>& points, int subdivisions);

/// Returns the pieces between neighboring points, except pieces along the axis, which have no area.
/// Pieces that meet at an angle of at most `crease` [degrees] have the same normals there. On the
/// axis the neighbor of a piece is its own mirror image.
std::vector<ProfilePiece> profile_pieces(const std::vector<Vec2>& points, float crease);

}  // namespace pharos
