#include "pmj02_tables.h"

#include <algorithm>
#include <bit>

#include "keyed_seeds.h"
#include "owen.h"

namespace pharos::pmj02 {
namespace {

/// Returns the number in the other half of the interval of length 2^-k that contains `partner`. Its
/// further digits come from `random`.
std::uint32_t beside(std::uint32_t partner, int k, std::uint32_t random) {
  const std::uint32_t free_digits = 0x7fffffffu >> k;
  return ((partner ^ (0x80000000u >> k)) & ~free_digits) | (random & free_digits);
}

class PreparedTables final : public PreparedSampler {
 public:
  PreparedTables(std::vector<Point> tables, int bits)
      : points_(std::move(tables)),
        bits_(bits),
        tables_(static_cast<std::uint32_t>(points_.size() >> bits)) {}

  std::uint64_t begin(const PathKey& key) const override {
    return SetPlace::of(key, 1u << bits_).state();
  }
  float value_1d(const SampleStream& stream, Dimension dimension) const override {
    return value_2d(stream, dimension).x;
  }
  Vec2 value_2d(const SampleStream& stream, Dimension dimension) const override {
    const SetPlace place(stream.state());
    const Seeds seeds = seeds_of(place.set_hash(), dimension);
    const std::uint32_t mask = (1u << bits_) - 1;
    const std::uint32_t index = owen::shuffle_index(place.index(), seeds.order) & mask;
    const std::uint64_t table = (std::uint64_t{seeds.more} * tables_) >> 32;
    const Point p = points_[(table << bits_) + index];
    return {to_unit_float(p.x ^ seeds.x), to_unit_float(p.y ^ seeds.y)};
  }

 private:
  std::vector<Point> points_;
  int bits_;
  std::uint32_t tables_;
};

}  // namespace

void double_sequence(std::vector<Point>& points, std::uint64_t seed) {
  const auto count = static_cast<std::uint32_t>(points.size());
  const int k = std::countr_zero(count);
  // In x the new point shares its interval with the point of the same lower index bits. In y it
  // shares its interval with the point whose index differs by the first k digits of column k of the
  // generator matrix.
  const std::uint32_t column = owen::sobol_y_reversed(count) & (count - 1);
  points.resize(2 * points.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint64_t random = hash_combine(seed, count + i);
    points[count + i] = {beside(points[i].x, k, static_cast<std::uint32_t>(random >> 32)),
                         beside(points[i ^ column].y, k, static_cast<std::uint32_t>(random))};
  }
}

std::vector<Point> sequence(int bits, std::uint64_t seed) {
  const std::uint64_t random = hash_combine(seed, 0);
  std::vector<Point> points;
  points.reserve(std::size_t{1} << bits);
  points.push_back({static_cast<std::uint32_t>(random >> 32), static_cast<std::uint32_t>(random)});
  for (int k = 0; k < bits; ++k) double_sequence(points, seed);
  return points;
}

int table_bits(const SamplePlan& plan) {
  constexpr int kLeast = 8, kUnknown = 12;
  if (plan.samples_per_pixel == 0) return kUnknown;
  const auto enough = static_cast<int>(std::bit_width(plan.samples_per_pixel - 1));
  return std::clamp(enough, kLeast, kMostBits);
}

std::unique_ptr<const PreparedSampler> make_sampler(std::vector<Point> tables, int bits) {
  return std::make_unique<PreparedTables>(std::move(tables), bits);
}

}  // namespace pharos::pmj02
