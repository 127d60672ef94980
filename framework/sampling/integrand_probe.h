#pragma once

#include <cstdint>
#include <span>

#include <pharos/core/rgb.h>
#include <pharos/core/vec.h>
#include <pharos/sampling/dimension.h>
#include <pharos/sampling/sampler.h>

namespace pharos {

/// The first surface that a pixel sees through its centre and the centre of the lens.
struct FirstHit {
  float depth = kInfinity;  ///< distance [scene units]; infinite when nothing is hit
  Vec3 normal;              ///< shading normal; zero when nothing is hit
  std::uint32_t object = 0;
};

/// The integrand of one dimension, laid open before rendering: offered by an integrator, asked by a
/// sampler. Thread-safe.
class IntegrandProbe {
 public:
  virtual ~IntegrandProbe() = default;

  virtual PixelGrid grid() const = 0;
  /// How many branches of light_position there are: the lights with selection `all`, else 1.
  virtual int light_branches() const = 0;

  /// The part of pixel (x, y)'s integrand that depends on `dimension`, as a function of the very
  /// primary numbers that a sampler would deliver for it, before any warp; all other numbers of the
  /// path are held at keyed_numbers() of the key `others` at this pixel. For light_position the
  /// contribution of that light sample alone; for other dimensions that of the whole path.
  /// values[i] belongs to points[i].
  virtual void evaluate(int x, int y, Dimension dimension, const PathKey& others,
                        std::span<const Vec2> points, std::span<Rgb> values) const = 0;

  virtual FirstHit first_hit(int x, int y) const = 0;
};

}  // namespace pharos
