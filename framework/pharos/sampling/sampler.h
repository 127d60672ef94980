#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include <pharos/config/component.h>
#include <pharos/core/rgb.h>
#include <pharos/core/vec.h>
#include <pharos/sampling/dimension.h>

namespace pharos {

class IntegrandProbe;
class PreparedSampler;

/// Names a path. Every number that a path sees is a function of this key and a Dimension.
struct PathKey {
  std::uint64_t seed = 0;
  std::uint32_t iteration = 0;  ///< of training; each is an independent image
  std::uint64_t index = 0;      ///< pixel (y * width + x) or path number
  std::uint32_t sample = 0;     ///< of this pixel within the iteration, from 0 on
};

/// The primary numbers of one path: a small value, free to copy. Asking twice for the same
/// dimension gives the same number; the order of asking does not matter.
class SampleStream {
 public:
  SampleStream(const PreparedSampler& sampler, const PathKey& key);
  /// With the state that the sampler's begin() made of this key before: for samplers that ask
  /// others and keep their state.
  SampleStream(const PreparedSampler& sampler, const PathKey& key, std::uint64_t state)
      : sampler_(&sampler), key_(key), state_(state) {}

  /// In [0, 1).
  float get_1d(Dimension dimension) const;
  /// In [0, 1)^2.
  Vec2 get_2d(Dimension dimension) const;

  const PathKey& key() const { return key_; }
  /// What PreparedSampler::begin() derived from the key.
  std::uint64_t state() const { return state_; }

 private:
  const PreparedSampler* sampler_;
  PathKey key_;
  std::uint64_t state_;
};

/// A stream seen from one path vertex.
class VertexStream {
 public:
  VertexStream(const SampleStream& stream, std::uint16_t bounce)
      : stream_(&stream), bounce_(bounce) {}

  float get_1d(Purpose purpose, std::uint16_t branch = 0) const {
    return stream_->get_1d({purpose, bounce_, branch});
  }
  Vec2 get_2d(Purpose purpose, std::uint16_t branch = 0) const {
    return stream_->get_2d({purpose, bounce_, branch});
  }

 private:
  const SampleStream* stream_;
  std::uint16_t bounce_;
};

/// An estimate of radiance at a film position, with the mean of the paths of its pixel.
struct FilmSample {
  Vec2 film;  ///< [pixels]
  Rgb radiance;
};

/// A sampler made ready for one render: constant, thread-safe, without memory of what was asked.
class PreparedSampler {
 public:
  virtual ~PreparedSampler() = default;

  /// Work that all numbers of a path share, such as hashing its key.
  virtual std::uint64_t begin(const PathKey& key) const = 0;
  /// In [0, 1).
  virtual float value_1d(const SampleStream& stream, Dimension dimension) const = 0;
  /// In [0, 1)^2.
  virtual Vec2 value_2d(const SampleStream& stream, Dimension dimension) const = 0;
  /// Estimates of the image that preparation has left over. Each counts in the color of the final
  /// image as one path more of its pixel. How many there are of a pixel must not depend on them.
  virtual std::span<const FilmSample> film_samples() const { return {}; }
};

/// The pixels that will be rendered.
struct PixelGrid {
  int width = 0, height = 0;
};

/// How many samples will be taken.
struct SamplePlan {
  std::uint64_t seed = 0;
  std::uint32_t samples_per_pixel = 0;  ///< of the longest iteration; 0: unknown (time budget)
};

/// Contract: where primary numbers come from. Samplers differ in how the numbers of different
/// samples of a pixel, and of different pixels, are arranged; each number alone is uniform.
class Sampler : public Component {
 public:
  static constexpr std::string_view contract_name = "sampler";

  /// Makes the sampler ready for a render. `probe` evaluates the integrand before rendering; it
  /// lives for this call only, and is null for integrators that offer none.
  virtual std::unique_ptr<const PreparedSampler> prepare(const PixelGrid& grid,
                                                         const SamplePlan& plan,
                                                         const IntegrandProbe* probe) const = 0;

  /// Size of the finite sets that a sampler works with: passes of the final image are whole sets,
  /// but for the last one where the number of samples is no multiple. 1: any count is as good, or
  /// sets are as long as an iteration, which any passes fill. `plan` states the samples of all
  /// iterations together, or 0 for a time budget, as the iterations are yet to be chosen.
  virtual std::uint32_t preferred_samples(const SamplePlan& /*plan*/) const { return 1; }
  /// Whether prepare() needs a probe.
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
