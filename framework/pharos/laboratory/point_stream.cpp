#include <pharos/core/random.h>
#include <pharos/experiments/pictures/sampled_points.h>
#include <pharos/laboratory/point_stream.h>

namespace pharos::laboratory {
namespace {

std::uint64_t hash(const SetKey& key) {
  return hash_combine(hash_combine(mix_bits(key.seed), key.log2_count), key.number);
}

/// Uses of a key's hash other than the seeds of paths.
enum Use : std::uint64_t { kShiftX = 1, kShiftY = 2, kTables = 3 };

double to_unit_double(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

double wrapped(double v) {
  return v < 1 ? v : v - 1;
}

}  // namespace

std::uint64_t seed_of(std::uint64_t seed, std::string_view sampler_name) {
  std::uint64_t hash = mix_bits(seed);
  for (const char c : sampler_name) hash = hash_combine(hash, static_cast<unsigned char>(c));
  return hash;
}

std::unique_ptr<const PreparedSampler> prepare(const Sampler& sampler, const SetKey& key) {
  return prepare_for_points(sampler, key.count(), hash_combine(hash(key), kTables));
}

std::vector<Vec2> point_set(const PreparedSampler& prepared, const SetKey& key) {
  return sampled_points(prepared, kDimension, key.count(), hash(key));
}

std::vector<PlanePoint> shifted_point_set(const PreparedSampler& prepared, const SetKey& key) {
  const PlanePoint shift{to_unit_double(hash_combine(hash(key), kShiftX)),
                         to_unit_double(hash_combine(hash(key), kShiftY))};
  std::vector<PlanePoint> shifted;
  shifted.reserve(key.count());
  for (const Vec2 p : point_set(prepared, key)) {
    shifted.push_back({wrapped(p.x + shift.x), wrapped(p.y + shift.y)});
  }
  return shifted;
}

}  // namespace pharos::laboratory
