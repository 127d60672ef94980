// sobol: each dimension of a pixel uses the first two dimensions of Sobol's sequence, a
// (0,2)-sequence, with its own Owen scramble and its own order (padding; Kollig and Keller 2002,
// Burley 2020, "Practical Hash-based Owen Scrambling"). If n is a power of two, the first n samples
// of a pixel are stratified in every elementary interval of area 1/n of every 2D dimension.
// Exceptions: numbers that choose a light, a lobe or a guide are the third or fourth dimension of
// the sequence whose points they divide, and guides have the order of the points of the BSDF.
// Other dimensions, pixels, iterations and seeds are unrelated. Any number of samples is possible;
// powers of two are best.
//
//     { type: sobol }
#include "sobol.h"

#include "keyed_seeds.h"
#include "owen.h"

namespace pharos {
namespace {

/// Which dimension of which sequence a number is.
struct Source {
  Dimension sequence;        ///< the dimension that has the sequence's first two dimensions
  std::uint32_t coordinate;  ///< of the sequence, from 0 on
};

/// A number that chooses a technique is a dimension of the sequence that gives the technique its
/// points. The points that each technique gets are then evenly spread. An independent choice would
/// take points out at random. The BSDF and the guides share one order, because a step uses either.
constexpr Source source_of(Dimension d) {
  const auto of = [&](Purpose points, std::uint32_t coordinate) {
    return Source{{points, d.bounce(), d.branch()}, coordinate};
  };
  switch (d.purpose()) {
    case Purpose::light_choice:
      return of(Purpose::light_position, 2);
    case Purpose::mix_choice:
      return of(Purpose::bsdf_direction, 2);
    case Purpose::bsdf_choice:
      return of(Purpose::bsdf_direction, 3);
    case Purpose::guide_direction:
      return of(Purpose::bsdf_direction, 0);
    default:
      return {d, 0};
  }
}

class PreparedSobol final : public PreparedSampler {
 public:
  /// Packs a hash that all samples of a pixel share into the upper half of the state, and the
  /// reversed number of the sample into the lower half.
  std::uint64_t begin(const PathKey& key) const override {
    return (hash_pixel(key) & 0xffffffff00000000ull) | owen::reverse_bits(key.sample);
  }
  float value_1d(const SampleStream& stream, Dimension dimension) const override {
    const Source source = source_of(dimension);
    const Seeds seeds = seeds_for(stream, dimension, source);
    const std::uint32_t place = shuffled(stream, seeds);
    if (source.coordinate == 0) return owen::sobol_number(place, seeds.x);
    const std::uint64_t later = owen::sobol_reversed(place, owen::kLaterSobolParts);
    return owen::scrambled_number(
        static_cast<std::uint32_t>(source.coordinate == 2 ? later : later >> 32), seeds.x);
  }
  Vec2 value_2d(const SampleStream& stream, Dimension dimension) const override {
    // Numbers that choose are one-dimensional. If one is asked for as a point, it has its own
    // sequence.
    const Source source = source_of(dimension);
    const Seeds seeds = source.coordinate == 0 ? seeds_for(stream, dimension, source)
                                               : seeds_of(stream.state() >> 32, dimension);
    return owen::sobol_point(shuffled(stream, seeds), seeds.x, seeds.y);
  }

 private:
  static Seeds seeds_for(const SampleStream& stream, Dimension dimension, const Source& source) {
    const std::uint64_t pixel = stream.state() >> 32;
    return source.sequence == dimension
               ? seeds_of(pixel, dimension)
               : seeds_of(pixel, source.sequence, static_cast<std::uint32_t>(dimension.purpose()));
  }
  /// Returns the place of the sample in the sequence, reversed.
  static std::uint32_t shuffled(const SampleStream& stream, const Seeds& seeds) {
    return owen::scramble_reversed(static_cast<std::uint32_t>(stream.state()), seeds.order);
  }
};

}  // namespace

std::unique_ptr<const PreparedSampler> SobolSampler::prepare(const PixelGrid&, const SamplePlan&,
                                                             const IntegrandProbe*) const {
  return std::make_unique<PreparedSobol>();
}

}  // namespace pharos
