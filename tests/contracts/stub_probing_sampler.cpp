// Stub (f): a sampler that probes the light-position integrand of pixel blocks before rendering. It
// shifts the numbers of each block, on the torus, to the brightest point of the integrand. Uniform
// numbers stay uniform under a shift, so only noise may change. On request it adds a left-over
// sample at the center of the first pixel.

#include <cmath>
#include <vector>

#include <pharos/config/registry.h>
#include <pharos/core/error.h>
#include <pharos/sampling/integrand_probe.h>
#include <pharos/sampling/keyed_numbers.h>

#include "stubs.h"

namespace pharos::stubs {
namespace {

constexpr int kBlock = 16;
constexpr int kGrid = 8;
constexpr Dimension kProbed{Purpose::light_position, 1, 0};

class ShiftedSampler final : public PreparedSampler {
 public:
  ShiftedSampler(const PixelGrid& grid, std::vector<Vec2> shifts, std::vector<FilmSample> left_over)
      : grid_(grid),
        columns_((grid.width + kBlock - 1) / kBlock),
        shifts_(std::move(shifts)),
        left_over_(std::move(left_over)) {}

  std::uint64_t begin(const PathKey& key) const override { return hash_key(key); }
  float value_1d(const SampleStream& stream, Dimension dimension) const override {
    return keyed_numbers(stream.state(), dimension).x;
  }
  Vec2 value_2d(const SampleStream& stream, Dimension dimension) const override {
    const Vec2 u = keyed_numbers(stream.state(), dimension);
    if (dimension != kProbed) return u;
    const auto index = static_cast<int>(stream.key().index);
    const int block = index / grid_.width / kBlock * columns_ + index % grid_.width / kBlock;
    const Vec2 shift = shifts_[static_cast<std::size_t>(block)];
    return {wrap(u.x + shift.x), wrap(u.y + shift.y)};
  }
  std::span<const FilmSample> film_samples() const override { return left_over_; }

 private:
  static float wrap(float v) { return std::min(v - std::floor(v), kOneMinusEpsilon); }

  PixelGrid grid_;
  int columns_;
  std::vector<Vec2> shifts_;
  std::vector<FilmSample> left_over_;
};

struct ProbingSettings {
  float left_over = 0;

  static void describe(Schema<ProbingSettings>& s) {
    s.field("left_over", &ProbingSettings::left_over,
            "Radiance of a sample that is left over from the probe");
  }
};

class ProbingSampler final : public Sampler {
 public:
  using Settings = ProbingSettings;
  explicit ProbingSampler(const Settings& settings) : settings_(settings) {}

  bool needs_probe() const override { return true; }
  std::unique_ptr<const PreparedSampler> prepare(const PixelGrid& grid, const SamplePlan& plan,
                                                 const IntegrandProbe* probe) const override {
    if (probe == nullptr) throw InputError("the sampler 'stub_probing' needs an integrand probe");
    std::vector<Vec2> shifts;
    for (int y = 0; y < grid.height; y += kBlock) {
      for (int x = 0; x < grid.width; x += kBlock) {
        shifts.push_back(brightest(*probe, {.seed = plan.seed}, x, y));
      }
    }
    std::vector<FilmSample> left_over;
    if (settings_.left_over > 0) left_over.push_back({{0.5f, 0.5f}, Rgb(settings_.left_over)});
    return std::make_unique<ShiftedSampler>(grid, std::move(shifts), std::move(left_over));
  }

 private:
  static Vec2 brightest(const IntegrandProbe& probe, const PathKey& others, int x, int y) {
    std::vector<Vec2> points;
    for (int i = 0; i < kGrid * kGrid; ++i) {
      points.push_back({(static_cast<float>(i % kGrid) + 0.5f) / kGrid,
                        (static_cast<float>(i / kGrid) + 0.5f) / kGrid});
    }
    std::vector<Rgb> values(points.size());
    probe.evaluate({.x = x, .y = y, .dimension = kProbed, .others = others}, points, values);
    std::size_t best = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (mean(values[i]) > mean(values[best])) best = i;
    }
    return points[best];
  }

  Settings settings_;
};

}  // namespace

void register_probing_sampler(Registry& registry) {
  registry.add<ProbingSampler>("stub_probing", "Shifts blocks by their light integrand");
}

}  // namespace pharos::stubs
