#pragma once

#include <cstdint>
#include <optional>

#include <pharos/config/schema.h>
#include <pharos/guiding/contract/learner.h>

#include "splat.h"

namespace pharos {

template <>
struct EnumNames<focal::SplatExtent> {
  static constexpr auto names = std::to_array<EnumName<focal::SplatExtent>>(
      {{"line", focal::SplatExtent::line},
       {"roughness_gated", focal::SplatExtent::roughness_gated}});
};
template <>
struct EnumNames<focal::SplatWeight> {
  static constexpr auto names = std::to_array<EnumName<focal::SplatWeight>>(
      {{"length", focal::SplatWeight::length}, {"share", focal::SplatWeight::share}});
};

namespace focal {

/// A box given by its corners [scene units].
struct RegionSettings {
  Vec3 low{-1, -1, -1}, high{1, 1, 1};
  static void describe(Schema<RegionSettings>& schema);
};

/// Parameters of the method; the defaults are the paper's.
struct FocalSettings {
  std::optional<RegionSettings> region;
  int region_growths = 0;
  float split_threshold = 1e-3f;
  int max_depth = 14;
  int narrowing_iterations = 5;
  std::optional<int> burn_in;  ///< iterations before narrowing; none: all but the last ones
  int catch_up = 0;
  double least_segments = 50;
  double caught_up_share = 0.5;
  std::uint32_t kept_segments = 65536;
  SplatExtent splat_extent = SplatExtent::line;
  float glossy_roughness = 0.3f;
  SplatWeight splat_weight = SplatWeight::length;
  float decay = 0, narrowing_decay = 0;
  bool mis_compensation = true;
  float prune_ratio = 2;
  int local_cells = 1;
  double local_prior = 30;

  static void describe(Schema<FocalSettings>& schema);
};

/// Learns a density of focal points, where light meets in space, from the path segments that carry
/// light (Rath et al. 2023).
class FocalLearner final : public Learner {
 public:
  using Settings = FocalSettings;
  /// Throws InputError if the region has no volume, or if both `catch_up` and `narrowing_decay` are
  /// above 0.
  explicit FocalLearner(const Settings& settings);

  LearnerTraits traits() const override;
  std::unique_ptr<LearningState> begin(const LearningContext& context) const override;
  std::shared_ptr<GuidingModel> empty_model() const override;

 private:
  Settings settings_;
};

}  // namespace focal
}  // namespace pharos
