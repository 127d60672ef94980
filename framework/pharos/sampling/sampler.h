#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include <pharos/config/component.h>
#include <pharos/core/archive.h>
#include <pharos/core/rgb.h>
#include <pharos/core/vec.h>
#include <pharos/sampling/dimension.h>

namespace pharos {

class IntegrandProbe;
class PreparedSampler;

/// Names a path. Every primary number of the path is a function of this key and a Dimension.
struct PathKey {
  std::uint64_t seed = 0;
  std::uint32_t iteration = 0;  ///< training iteration; each is an independent image
  std::uint64_t index = 0;      ///< pixel (y * width + x) or path number
  std::uint32_t sample = 0;     ///< sample of this pixel within the iteration, from 0 on

  void archive(Archive& archive) { archive(seed, iteration, index, sample); }
};

/// The primary numbers of one path: a small value that is free to copy. Repeated requests for the
/// same dimension return the same number. The order of requests does not matter.
class SampleStream {
 public:
  SampleStream(const PreparedSampler& sampler, const PathKey& key);
  /// Makes a stream with a state that the sampler's begin() computed from this key before. For
  /// samplers that use other samplers and keep their state.
  SampleStream(const PreparedSampler& sampler, const PathKey& key, std::uint64_t state)
      : sampler_(&sampler), key_(key), state_(state) {}

  /// Returns a number in [0, 1).
  float get_1d(Dimension dimension) const;
  /// Returns a point in [0, 1)^2.
  Vec2 get_2d(Dimension dimension) const;

  const PathKey& key() const { return key_; }
  /// The value that PreparedSampler::begin() computed from the key.
  std::uint64_t state() const { return state_; }

 private:
  const PreparedSampler* sampler_;
  PathKey key_;
  std::uint64_t state_;
};

/// A stream as seen from one path vertex.
class VertexStream {
 public:
  VertexStream(const SampleStream& stream, std::uint16_t bounce)
      : stream_(&stream), bounce_(bounce) {}

  /// Returns the number of the path's stream. After after_choice(), guide_choice is another one.
  float get_1d(Purpose purpose, std::uint16_t branch = 0) const {
    if (purpose == Purpose::guide_choice && branch == 0 && rest_ >= 0) return rest_;
    const float u = stream_->get_1d({purpose, bounce_, shifted(branch)});
    return copy_ == 0 ? u : on_circle(u, kGoldenRatio);
  }
  Vec2 get_2d(Purpose purpose, std::uint16_t branch = 0) const {
    const Vec2 u = stream_->get_2d({purpose, bounce_, shifted(branch)});
    return copy_ == 0 ? u : Vec2{on_circle(u.x, kPlasticRatio), on_circle(u.y, kPlasticSquare)};
  }
  /// Returns the numbers of step or light sample `index` where a vertex has several. Copy 0 has the
  /// numbers of this stream. Each other copy adds a point of a low-discrepancy sequence, modulo 1,
  /// so the copies of each number are evenly spread. The sequence consists of the multiples of the
  /// golden ratio in one dimension. In two dimensions it is the sequence R2 of Roberts (2018, "The
  /// Unreasonable Effectiveness of Quasirandom Sequences").
  VertexStream copy(std::uint32_t index) const {
    VertexStream stream = *this;
    stream.copy_ = index;
    return stream;
  }
  /// Returns the numbers of candidate `index` for the next step, below kMostCandidates. Candidate 0
  /// has the numbers of this stream.
  VertexStream candidate(std::uint32_t index) const {
    VertexStream stream = *this;
    stream.first_branch_ = static_cast<std::uint16_t>(index * (0x10000 / kMostCandidates));
    return stream;
  }
  static constexpr std::uint32_t kMostCandidates = 16;
  /// Returns a stream whose number guide_choice, branch 0, is `rest` in [0, 1): the number
  /// that has chosen the guide, scaled so that it is uniform again. A sampler that stratifies this
  /// choice then also stratifies the choices of the guide.
  VertexStream after_choice(float rest) const {
    VertexStream stream = *this;
    stream.rest_ = rest;
    return stream;
  }

 private:
  /// Fractions of a turn, in units of 2^-32. A 32-bit product wraps around like the circle.
  static constexpr std::uint32_t kGoldenRatio = 2654435769u;    ///< (sqrt(5) - 1) / 2
  static constexpr std::uint32_t kPlasticRatio = 3242174889u;   ///< 1 / 1.3247..., x^3 = x + 1
  static constexpr std::uint32_t kPlasticSquare = 2447445414u;  ///< its square

  /// Moves a number of [0, 1) by `copy_` times `step` on the circle.
  float on_circle(float u, std::uint32_t step) const {
    // The upper 24 bits are exact as a float.
    const float moved = u + static_cast<float>((copy_ * step) >> 8) * 0x1p-24f;
    return moved < 1 ? moved : moved - 1;
  }
  /// Branches count modulo 2^16.
  std::uint16_t shifted(std::uint16_t branch) const {
    return static_cast<std::uint16_t>(first_branch_ + branch);
  }

  const SampleStream* stream_;
  std::uint16_t bounce_;
  std::uint16_t first_branch_ = 0;
  std::uint32_t copy_ = 0;  ///< see copy()
  float rest_ = -1;         ///< negative: none
};

/// An estimate of radiance at a film position. Its expected value is the expected value of the
/// paths of its pixel.
struct FilmSample {
  Vec2 film;  ///< [pixels]
  Rgb radiance;
};

/// A sampler that is prepared for one render. It is constant and thread-safe, and it does not
/// remember earlier requests.
class PreparedSampler {
 public:
  virtual ~PreparedSampler() = default;

  /// Does the work that all numbers of a path share, such as hashing its key. Returns the state of
  /// the stream.
  virtual std::uint64_t begin(const PathKey& key) const = 0;
  /// Returns a number in [0, 1).
  virtual float value_1d(const SampleStream& stream, Dimension dimension) const = 0;
  /// Returns a point in [0, 1)^2.
  virtual Vec2 value_2d(const SampleStream& stream, Dimension dimension) const = 0;
  /// Returns estimates of the image that are left over from preparation. Each counts in the color
  /// of the final image like one more path of its pixel. The number of estimates of a pixel must
  /// not depend on their values.
  virtual std::span<const FilmSample> film_samples() const { return {}; }
};

/// The size of the film [pixels].
struct PixelGrid {
  int width = 0, height = 0;
};

/// The seed and the number of samples that will be taken.
struct SamplePlan {
  std::uint64_t seed = 0;
  /// In the longest iteration, as planned before the render; 0: unknown (time budget). If training
  /// takes less than planned, the final image has more.
  std::uint32_t samples_per_pixel = 0;
};

/// Contract: a source of primary numbers. Samplers differ in how they arrange the numbers of
/// different samples of a pixel and of different pixels. Each number alone is uniform.
class Sampler : public Component {
 public:
  static constexpr std::string_view contract_name = "sampler";

  /// Prepares the sampler for a render. `probe` evaluates the integrand before rendering. It is
  /// valid during this call only, and it is null if the integrator offers no probe.
  virtual std::unique_ptr<const PreparedSampler> prepare(const PixelGrid& grid,
                                                         const SamplePlan& plan,
                                                         const IntegrandProbe* probe) const = 0;

  /// Returns the number of samples per pixel in the finite sets that the sampler works with. Passes
  /// of the final image consist of whole sets, except for the last pass if the number of samples is
  /// not a multiple. Returns 1 if any count is as good, or if sets are as long as an iteration,
  /// because any passes then fill them. `plan` holds the samples of all iterations together,
  /// because the iterations are chosen later, or 0 for a time budget.
  virtual std::uint32_t preferred_samples(const SamplePlan& /*plan*/) const { return 1; }
  /// Returns whether prepare() needs a probe.
  virtual bool needs_probe() const { return false; }
};

inline SampleStream::SampleStream(const PreparedSampler& sampler, const PathKey& key)
    : sampler_(&sampler), key_(key), state_(sampler.begin(key)) {}
inline float SampleStream::get_1d(Dimension dimension) const {
  return sampler_->value_1d(*this, dimension);
}
inline Vec2 SampleStream::get_2d(Dimension dimension) const {
  return sampler_->value_2d(*this, dimension);
}

}  // namespace pharos
