#pragma once

#include <pharos/core/vec.h>

namespace pharos {

/// The roughness of a microfacet surface along x and y, and the map to the space where both are
/// one. In this space every distribution has a single shape (Heitz 2014, "Understanding the
/// Masking-Shadowing Function in Microfacet-Based BRDFs").
class FacetStretch {
 public:
  /// Both roughnesses are in (0, 1].
  FacetStretch(float alpha_x, float alpha_y)
      : alpha_x_(alpha_x),
        alpha_y_(alpha_y),
        y_over_x_(alpha_y / alpha_x),
        x_over_y_(alpha_x / alpha_y) {}

  /// The product of both roughnesses [1].
  float product() const { return alpha_x_ * alpha_y_; }

  /// (m.x / alpha_x)^2 + (m.y / alpha_y)^2, multiplied by product() [1].
  float scaled_tilt_squared(Vec3 m) const {
    const float x = y_over_x_ * m.x, y = x_over_y_ * m.y;
    return x * m.x + y * m.y;
  }

  /// (alpha_x w.x)^2 + (alpha_y w.y)^2: the squared length of the horizontal part of the stretched
  /// `w` [1].
  float level_squared(Vec3 w) const {
    const float y = y_over_x_ * w.y;
    return alpha_x_ * alpha_x_ * (w.x * w.x + y * y);
  }

  /// Maps a direction to the stretched space, or a facet's normal back from it. The result does not
  /// have unit length.
  Vec3 operator()(Vec3 v) const { return {alpha_x_ * v.x, alpha_y_ * v.y, v.z}; }

 private:
  float alpha_x_, alpha_y_;
  float y_over_x_, x_over_y_;  ///< ratios of the roughnesses, exactly one if both are equal
};

}  // namespace pharos
