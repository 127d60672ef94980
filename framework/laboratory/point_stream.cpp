#include <pharos/core/random.h>
#include <pharos/laboratory/point_stream.h>

namespace pharos::laboratory {
namespace {

std::uint64_t hash(const SetKey& key) {
  return hash_combine(hash_combine(mix_bits(key.seed), key.log2_count), key.realisation);
}

double to_unit_double(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

double wrapped(double v) {
  return v < 1 ? v : v - 1;
}

}  // namespace

std::unique_ptr<const PreparedSampler> prepare(const Sampler& sampler, std::uint64_t seed,
                                               std::uint32_t log2_count) {
  return sampler.prepare({1, 1}, {seed, std::uint32_t{1} << log2_count}, nullptr);
}

std::vector<Vec2> point_set(const PreparedSampler& prepared, const SetKey& key) {
  const std::uint64_t path_seed = hash(key);
  std::vector<Vec2> points(key.count());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const SampleStream stream(prepared, {.seed = path_seed, .sample = i});
    points[i] = stream.get_2d({Purpose::light_position, 1});
  }
  return points;
}

std::vector<PlanePoint> shifted_point_set(const PreparedSampler& prepared, const SetKey& key) {
  const std::uint64_t first = hash_combine(hash(key), 1), second = hash_combine(hash(key), 2);
  const PlanePoint shift{to_unit_double(first), to_unit_double(second)};
  std::vector<PlanePoint> shifted;
  shifted.reserve(key.count());
  for (const Vec2 p : point_set(prepared, key)) {
    shifted.push_back({wrapped(p.x + shift.x), wrapped(p.y + shift.y)});
  }
  return shifted;
}

}  // namespace pharos::laboratory
