// toroidal_shift: the same points in every pixel, moved by an offset of the pixel's own, with what
// leaves the unit square coming in on its other side (Cranley and Patterson 1976, "Randomization of
// Number Theoretic Methods for Multiple Integration"). The points are those that `base` has for
// the first pixel, and a seed of its own; every dimension of a pixel has an offset. An offset makes
// the arrangement the same about every place, as studies of spectra and convergence ask for, but a
// net that is moved is no net: for rendering `base` alone is mostly better.
//
//     { type: toroidal_shift, base: multi_jittered }
#include "toroidal_shift.h"

#include <pharos/config/registry.h>

#include "keyed_seeds.h"
#include "unit_steps.h"

namespace pharos {
namespace {

class PreparedToroidalShift final : public PreparedSampler {
 public:
  explicit PreparedToroidalShift(std::unique_ptr<const PreparedSampler> base)
      : base_(std::move(base)) {}

  std::uint64_t begin(const PathKey& key) const override { return base_->begin(base_key(key)); }
  float value_1d(const SampleStream& stream, Dimension dimension) const override {
    const float u = base_->value_1d(base_stream(stream), dimension);
    return moved({u, 0}, offset(stream, dimension)).x;
  }
  Vec2 value_2d(const SampleStream& stream, Dimension dimension) const override {
    return moved(base_->value_2d(base_stream(stream), dimension), offset(stream, dimension));
  }
  std::span<const FilmSample> film_samples() const override { return base_->film_samples(); }

 private:
  /// Of the first pixel. The seed is another one, so that a base that moves points itself does not
  /// move them by this one's offsets.
  static PathKey base_key(PathKey key) {
    key.seed += 0x3c6ef372fe94f82bull;
    key.index = 0;
    return key;
  }
  SampleStream base_stream(const SampleStream& stream) const {
    return SampleStream(*base_, base_key(stream.key()), stream.state());
  }
  /// Of both coordinates, in the upper 24 bits of each half, as steps of 2^-24.
  static std::uint64_t offset(const SampleStream& stream, Dimension dimension) {
    return hash_pixel(stream.key(), dimension.code());
  }

  std::unique_ptr<const PreparedSampler> base_;
};

}  // namespace

void ToroidalShiftSampler::Settings::describe(Schema<Settings>& s) {
  s.field("base", &Settings::base, "Sampler of the points that are moved").otherwise("pmj02");
  s.example("{ base: { type: multi_jittered, samples: 16 } }");
}

std::unique_ptr<const PreparedSampler> ToroidalShiftSampler::prepare(
    const PixelGrid& grid, const SamplePlan& plan, const IntegrandProbe* probe) const {
  return std::make_unique<PreparedToroidalShift>(base_->prepare(grid, plan, probe));
}

}  // namespace pharos
