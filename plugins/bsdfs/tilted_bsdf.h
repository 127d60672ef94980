#pragma once

#include <optional>

#include <pharos/scene/bsdf.h>

namespace pharos {

/// A BSDF in a shading frame that is tilted from point to point: the base of bump_map and
/// normal_map.
///
/// The nested BSDF is asked in the tilted frame, whose s stays above the surface's. A direction
/// that lies on different sides of the surface and of the tilted plane scatters nothing, so that no
/// light leaks through; it is lost, and never gained. The BSDF about the tilted normal is
/// reciprocal if the nested one is, but cosines to that normal are not those of the flow of light
/// through the surface. As for shading normals, importance carries the correction that makes both
/// transports agree (Veach 1997, eq. 5.19), and may gain. What passes straight through is as it is.
class TiltedBsdf : public Bsdf {
 public:
  explicit TiltedBsdf(Ref<Bsdf> bsdf) : bsdf_(std::move(bsdf)) {}

  EventMask events() const override { return bsdf_->events(); }
  ScatterValue evaluate(const SurfacePoint& point, Vec3 wo, Vec3 wi,
                        ScatterOptions options) const override;
  std::optional<ScatterSample> sample(const SurfacePoint& point, Vec3 wo, float u_choice, Vec2 u,
                                      ScatterOptions options) const override;
  DiscreteOutcomes discrete(const SurfacePoint& point, Vec3 wo,
                            ScatterOptions options) const override;
  float roughness(const SurfacePoint& point) const override { return bsdf_->roughness(point); }
  float relative_ior() const override { return bsdf_->relative_ior(); }
  Rgb albedo(const SurfacePoint& point) const override { return bsdf_->albedo(point); }
  bool needs_tangents() const override { return true; }
  bool tilts_normal() const override { return true; }

 protected:
  /// The tilted normal in the point's shading frame, of any length; (0, 0, 1) where nothing is
  /// known. One that lies below the surface, or nearly, is lifted to where it is just above; one
  /// that is zero or not finite tilts nothing.
  virtual Vec3 normal(const SurfacePoint& point) const = 0;

 private:
  /// The tilted frame, in coordinates of the point's own, and the point with it.
  struct Tilt {
    Frame frame;
    SurfacePoint point;
  };
  /// Empty where nothing is tilted.
  std::optional<Tilt> tilt(const SurfacePoint& point) const;

  Ref<Bsdf> bsdf_;
};

}  // namespace pharos
