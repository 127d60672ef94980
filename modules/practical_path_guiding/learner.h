#pragma once

#include <array>
#include <string_view>
#include <utility>

#include <pharos/config/schema.h>
#include <pharos/guiding/contract/learner.h>

#include "records.h"

namespace pharos {
namespace practical_path_guiding {

enum class SpatialFilter {
  nearest,    ///< the cell that contains the record
  stochastic  ///< the cell at a random point within a box of that cell's size around the record
};
enum class DirectionalFilter {
  nearest,  ///< the leaf that contains the direction
  box       ///< all leaves, by their shares of a box of that leaf's size around the direction
};

/// Parameters of the method. The README documents them and states their sources.
struct PracticalPathGuidingSettings {
  double spatial_threshold = 4000;
  int spatial_depth = 40;
  bool by_facing = false;
  double directional_threshold = 0.01;
  int directional_depth = 20;
  SpatialFilter spatial_filter = SpatialFilter::stochastic;
  DirectionalFilter directional_filter = DirectionalFilter::box;
  GuidingTarget target = GuidingTarget::radiance;
  LightHits light_hits = LightHits::weighted;
  double memory = 0;
  double spatial_prior = 0;
  double directional_prior = 0;
  int pixel_radius = 2;
  double least_pixel = 0.01;
  std::uint32_t batch_records = 1u << 20;

  static void describe(Schema<PracticalPathGuidingSettings>& schema);
};

/// Learns an SD-tree (Mueller et al. 2017, with the improvements of 2019).
class PracticalPathGuidingLearner final : public Learner {
 public:
  using Settings = PracticalPathGuidingSettings;
  explicit PracticalPathGuidingLearner(const Settings& settings) : settings_(settings) {}

  LearnerTraits traits() const override;
  std::unique_ptr<LearningState> begin(const LearningContext& context) const override;
  std::shared_ptr<GuidingModel> empty_model() const override;

 private:
  Settings settings_;
};

}  // namespace practical_path_guiding

template <>
struct EnumNames<practical_path_guiding::SpatialFilter> {
  static constexpr auto names = std::to_array<EnumName<practical_path_guiding::SpatialFilter>>(
      {{"nearest", practical_path_guiding::SpatialFilter::nearest},
       {"stochastic", practical_path_guiding::SpatialFilter::stochastic}});
};
template <>
struct EnumNames<practical_path_guiding::DirectionalFilter> {
  static constexpr auto names = std::to_array<EnumName<practical_path_guiding::DirectionalFilter>>(
      {{"nearest", practical_path_guiding::DirectionalFilter::nearest},
       {"box", practical_path_guiding::DirectionalFilter::box}});
};

}  // namespace pharos
