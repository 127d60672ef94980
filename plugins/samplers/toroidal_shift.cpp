// toroidal_shift: the same points in every pixel, moved by an offset of the pixel's own, with what
// leaves the unit square coming in on its other side (Cranley and Patterson 1976, "Randomization of
// Number Theoretic Methods for Multiple Integration"). The points are those that `base` has for
// the first pixel; every dimension of a pixel has an offset. An offset makes the arrangement the
// same about every place, as studies of spectra and convergence ask for, but a net that is moved is
// no net: for rendering `base` alone is mostly better.
//
//     { type: toroidal_shift, base: multi_jittered }
#include "toroidal_shift.h"

#include <cmath>

#include <pharos/config/registry.h>
#include <pharos/core/random.h>

#include "keyed_seeds.h"

namespace pharos {
namespace {

class PreparedToroidalShift final : public PreparedSampler {
 public:
  explicit PreparedToroidalShift(std::unique_ptr<const PreparedSampler> base)
      : base_(std::move(base)) {}

  std::uint64_t begin(const PathKey& key) const override { return base_->begin(first_pixel(key)); }
  float value_1d(const SampleStream& stream, Dimension dimension) const override {
    return moved(base_->value_1d(stream, dimension), offset(stream, dimension).x);
  }
  Vec2 value_2d(const SampleStream& stream, Dimension dimension) const override {
    const Vec2 u = base_->value_2d(stream, dimension), by = offset(stream, dimension);
    return {moved(u.x, by.x), moved(u.y, by.y)};
  }

 private:
  static PathKey first_pixel(PathKey key) {
    key.index = 0;
    return key;
  }
  static Vec2 offset(const SampleStream& stream, Dimension dimension) {
    constexpr std::uint64_t kOffsets = 0x3c6ef372fe94f82bull;  // apart from other uses of the hash
    return to_unit_vec2(hash_combine(hash_pixel(stream.key()) ^ kOffsets, dimension.code()));
  }
  /// Down, as both are multiples of 2^-24: differences below one are exact, sums above it are not.
  static float moved(float u, float by) { return u - by - std::floor(u - by); }

  std::unique_ptr<const PreparedSampler> base_;
};

}  // namespace

void ToroidalShiftSampler::Settings::describe(Schema<Settings>& s) {
  s.field("base", &Settings::base, "Sampler of the points that are moved").otherwise("sobol");
  s.example("{ base: { type: multi_jittered, samples: 16 } }");
}

std::unique_ptr<const PreparedSampler> ToroidalShiftSampler::prepare(
    const PixelGrid& grid, const SamplePlan& plan, const IntegrandProbe* probe) const {
  return std::make_unique<PreparedToroidalShift>(base_->prepare(grid, plan, probe));
}

}  // namespace pharos
