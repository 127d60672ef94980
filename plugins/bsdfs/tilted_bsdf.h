#pragma once

#include <optional>

#include <pharos/scene/bsdf.h>

namespace pharos {

/// A BSDF in a shading frame that is tilted from point to point; the base of bump_map and
/// normal_map.
///
/// The nested BSDF is evaluated in the tilted frame. The tangent s of this frame lies above the
/// surface's s. A direction that lies on different sides of the surface and of the tilted plane
/// scatters nothing, so that no light leaks through. This light is lost; the tilt never adds any.
/// If the nested BSDF is reciprocal, it stays so about the tilted normal. However, cosines to the
/// tilted normal do not describe the flow of light through the surface. As with shading normals,
/// importance is multiplied by the correction that makes both transports agree (Veach 1997, eq.
/// 5.19), and may gain energy. Light that passes straight through is not changed.
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
  /// The tilted normal in the point's shading frame, of any length. It is (0, 0, 1) if the tilt is
  /// unknown. A normal below the surface or nearly level with it is lifted to just above the
  /// surface. A normal that is zero or not finite tilts nothing.
  virtual Vec3 normal(const SurfacePoint& point) const = 0;

 private:
  /// The tilted frame in coordinates of the point's own frame, and the point with this frame.
  struct Tilt {
    Frame frame;
    SurfacePoint point;
  };
  /// Empty if nothing is tilted.
  std::optional<Tilt> tilt(const SurfacePoint& point) const;

  Ref<Bsdf> bsdf_;
};

}  // namespace pharos
