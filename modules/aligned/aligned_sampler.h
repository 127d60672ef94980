#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include <pharos/config/schema.h>
#include <pharos/sampling/purpose_names.h>
#include <pharos/sampling/sampler.h>

#include "direction_field.h"

namespace pharos::aligned {

/// See aligned_sampler.cpp.
struct AlignedSettings {
  Ref<Sampler> base;
  std::vector<Purpose> purposes{Purpose::light_position};
  int lights = 4;
  int directions = 3;
  bool ordered_choice = false;
  std::vector<double> angles;
  std::optional<std::uint32_t> samples;
  bool synthesize = false;
  EstimationSettings estimation;
  int pair_step = 5;
  std::filesystem::path cache_folder;

  static void describe(Schema<AlignedSettings>& schema);
};

/// Draws points that are aligned with the edges of integrands.
class AlignedSampler final : public Sampler {
 public:
  using Settings = AlignedSettings;
  /// Throws InputError for purposes that cannot be aligned, for more angles than directions, for
  /// set sizes that do not exist, and for tiles that do not divide the grid.
  explicit AlignedSampler(const Settings& settings);

  std::unique_ptr<const PreparedSampler> prepare(const PixelGrid& grid, const SamplePlan& plan,
                                                 const IntegrandProbe* probe) const override;
  std::uint32_t preferred_samples(const SamplePlan& plan) const override;
  bool needs_probe() const override {
    return settings_.angles.empty() || settings_.base->needs_probe();
  }

  /// Returns the directions that prepare() estimates. Throws InputError without a probe.
  DirectionField estimate(const IntegrandProbe* probe, std::uint64_t seed) const;

  /// Returns the number of points per set. `samples_per_pixel` is 0 for a time budget.
  std::uint32_t set_size(std::uint32_t samples_per_pixel) const;

 private:
  Settings settings_;
};

}  // namespace pharos::aligned
