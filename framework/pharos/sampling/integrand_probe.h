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
  float depth = kInfinity;  ///< distance [scene units]; infinite when nothing is hit
  Vec3 normal;              ///< shading normal; zero when nothing is hit
  std::uint32_t object = 0;
};

/// What of a pixel's integrand is asked for.
struct ProbeQuery {
  int x = 0, y = 0;  ///< the pixel
  Dimension dimension{Purpose::light_position, 1};
  /// All other numbers of the path are keyed_numbers() of this key, at the pixel.
  PathKey others;
  /// Segments of the longest path that counts; the integrator's own limit holds as well.
  std::uint16_t max_depth = 0xffff;
};

/// The integrand of one dimension, laid open before rendering: offered by an integrator, asked by a
/// sampler. Thread-safe.
class IntegrandProbe {
 public:
  virtual ~IntegrandProbe() = default;

  virtual PixelGrid grid() const = 0;
  /// The pixels that will be rendered.
  virtual PixelRect window() const = 0;
  /// How many branches of light_position there are: the lights with selection `all`, else 1.
  virtual int light_branches() const = 0;

  /// The part of the pixel's integrand that depends on the dimension, as a function of the very
  /// primary numbers that a sampler would deliver for it, before any warp. For light_position the
  /// contribution of that light sample alone; for other dimensions that of the whole path.
  /// values[i] belongs to points[i]; what the points share is done once.
  virtual void evaluate(const ProbeQuery& query, std::span<const Vec2> points,
                        std::span<Rgb> values) const = 0;

  /// The whole path at one point of the dimension: an unguided sample of the image.
  /// `query.max_depth` does not apply, only the integrator's own limit.
  virtual FilmSample whole_path(const ProbeQuery& query, Vec2 point) const = 0;

  virtual FirstHit first_hit(int x, int y) const = 0;
};

}  // namespace pharos
