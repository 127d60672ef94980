#include "learner.h"

#include <pharos/core/error.h>

#include "learning_state.h"
#include "model.h"

namespace pharos::focal {

void RegionSettings::describe(Schema<RegionSettings>& s) {
  s.field("low", &RegionSettings::low, "Lower corner").unit("scene units").required();
  s.field("high", &RegionSettings::high, "Upper corner").unit("scene units").required();
}

void FocalSettings::describe(Schema<FocalSettings>& s) {
  using S = FocalSettings;
  s.field("region", &S::region,
          "Where focal points may lie; by default the bounds of geometry and sensor");
  s.field("region_growths", &S::region_growths,
          "How often the region may double, each time after an iteration before narrowing in which "
          "its densest place is at its boundary: virtual images may lie outside the scene")
      .at_least(0)
      .at_most(8);
  s.field("split_threshold", &S::split_threshold,
          "Share of all mass above which a cell is divided (gamma)")
      .at_least(1e-6)
      .at_most(1);
  s.field("max_depth", &S::max_depth, "Depth of the finest cells: edges are 2^-(depth + 1)")
      .at_least(0)
      .at_most(Octree::kMostLevels - 1);
  s.field(
       "narrowing_iterations", &S::narrowing_iterations,
       "How many of the last training iterations narrow the density to true focal points; at most "
       "a third of them all")
      .at_least(0);
  s.field("splat_extent", &S::splat_extent,
          "What a path meets: all of each segment's line (paper), or the segment alone unless its "
          "end is nearly specular (authors' code)");
  s.field("glossy_roughness", &S::glossy_roughness,
          "Roughness below which an end is nearly specular, for `roughness_gated`")
      .at_least(0)
      .at_most(1);
  s.field("splat_weight", &S::splat_weight,
          "What a cell gets before narrowing: by the length within it (paper), or by its share of "
          "the segment (authors' code)");
  s.field("decay", &S::decay,
          "Share of earlier iterations' masses that is kept: 0 (paper), 0.5 (authors' code)")
      .at_least(0)
      .below(1);
  s.field("narrowing_decay", &S::narrowing_decay,
          "The same once narrowing has begun: 0 (paper), 0.25 (authors' code)")
      .at_least(0)
      .below(1);
  s.field("mis_compensation", &S::mis_compensation,
          "Leave to the BSDF what it samples well, while narrowing");
  s.field("prune_ratio", &S::prune_ratio,
          "After training, nodes in which no leaf is denser than this many times their mean become "
          "leaves; 0 keeps all")
      .at_least(0);
}

FocalLearner::FocalLearner(const Settings& settings) : settings_(settings) {
  if (!settings.region) return;
  const Vec3 extent = settings.region->high - settings.region->low;
  if (!(extent.x > 0 && extent.y > 0 && extent.z > 0)) {
    throw InputError("the region's upper corner must be above its lower one along every axis");
  }
}

LearnerTraits FocalLearner::traits() const {
  return {.records = {.light_samples = true}};
}

std::unique_ptr<LearningState> FocalLearner::begin(const LearningContext& context) const {
  return std::make_unique<FocalLearningState>(settings_, context);
}

std::shared_ptr<GuidingModel> FocalLearner::empty_model() const {
  return std::make_shared<FocalModel>();
}

}  // namespace pharos::focal
