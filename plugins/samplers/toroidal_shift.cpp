// toroidal_shift: the same points in every pixel, moved by the pixel's own offset; a point that
// leaves the unit square enters it again on the opposite side (Cranley and Patterson 1976,
// "Randomization of Number Theoretic Methods for Multiple Integration"). The points are those of
// `base` for the first pixel and a separate seed. Every dimension of a pixel has its own offset.
// The offset makes the arrangement the same around every place, as studies of spectra and
// convergence require. However, a moved net is not a net: for rendering, `base` alone is usually
// better.
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
  /// Returns the key of the first pixel with a different seed. If `base` moves points itself, it
  /// therefore does not move them by the offsets of this sampler.
  static PathKey base_key(PathKey key) {
    key.seed += 0x3c6ef372fe94f82bull;
    key.index = 0;
    return key;
  }
  SampleStream base_stream(const SampleStream& stream) const {
    return SampleStream(*base_, base_key(stream.key()), stream.state());
  }
  /// Returns the offsets of both coordinates, in the upper 24 bits of each half, as steps of 2^-24.
  static std::uint64_t offset(const SampleStream& stream, Dimension dimension) {
    return hash_pixel(stream.key(), dimension.code());
  }

  std::unique_ptr<const PreparedSampler> base_;
};

}  // namespace

void ToroidalShiftSampler::Settings::describe(Schema<Settings>& s) {
  s.field("base", &Settings::base, "Sampler that provides the points").otherwise("pmj02");
  s.example("{ base: { type: multi_jittered, samples: 16 } }");
}

std::unique_ptr<const PreparedSampler> ToroidalShiftSampler::prepare(
    const PixelGrid& grid, const SamplePlan& plan, const IntegrandProbe* probe) const {
  return std::make_unique<PreparedToroidalShift>(base_->prepare(grid, plan, probe));
}

}  // namespace pharos
