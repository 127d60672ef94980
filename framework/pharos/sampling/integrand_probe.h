#pragma once

#include <cstdint>
#include <span>

#include <pharos/core/pixel_rect.h>
#include <pharos/core/rgb.h>
#include <pharos/core/vec.h>
#include <pharos/sampling/dimension.h>
#include <pharos/sampling/sampler.h>

namespace pharos {

/// The first surface that a pixel sees through its center and the center of the lens.
struct FirstHit {
  float depth = kInfinity;  ///< distance [scene units]; infinite if nothing is hit
  Vec3 normal;              ///< shading normal; zero if nothing is hit
  std::uint32_t object = 0;
};

/// The part of a pixel's integrand to evaluate.
struct ProbeQuery {
  int x = 0, y = 0;  ///< the pixel
  Dimension dimension{Purpose::light_position, 1};
  /// The key of all other numbers of the path, which are the keyed_numbers() of this key at the
  /// pixel.
  PathKey others;
  /// The number of segments of the longest path that counts. The limit of the integrator applies,
  /// too.
  std::uint16_t max_depth = 0xffff;
};

/// Gives access to the integrand of one dimension before rendering. An integrator offers it and a
/// sampler uses it. Thread-safe.
class IntegrandProbe {
 public:
  virtual ~IntegrandProbe() = default;

  virtual PixelGrid grid() const = 0;
  /// The pixels that will be rendered.
  virtual PixelRect window() const = 0;
  /// The number of branches of light_position: the number of lights with selection `all`, else 1.
  virtual int light_branches() const = 0;

  /// Evaluates the part of the pixel's integrand that depends on the dimension. The points are the
  /// very primary numbers that a sampler would deliver for the dimension, before any warp. For
  /// light_position, the value is the contribution of that light sample alone; for other
  /// dimensions, it is the contribution of the whole path. values[i] belongs to points[i]. Work
  /// that the points share is done once.
  virtual void evaluate(const ProbeQuery& query, std::span<const Vec2> points,
                        std::span<Rgb> values) const = 0;

  /// Evaluates the whole path at one point of the dimension: an unguided sample of the image.
  /// Ignores `query.max_depth`; only the limit of the integrator applies.
  virtual FilmSample whole_path(const ProbeQuery& query, Vec2 point) const = 0;

  virtual FirstHit first_hit(int x, int y) const = 0;
};

}  // namespace pharos
