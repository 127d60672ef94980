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
          "Box that can contain focal points; by default the bounds of geometry and sensor");
  s.field("region_growths", &S::region_growths,
          "How often the region may double in size: after an iteration before narrowing, if its "
          "densest cell touches its boundary, because virtual images may lie outside the scene")
      .at_least(0)
      .at_most(8);
  s.field("split_threshold", &S::split_threshold,
          "Share of the total mass above which a cell is split (gamma)")
      .at_least(1e-6)
      .at_most(1);
  s.field("max_depth", &S::max_depth,
          "Maximum depth of leaves, whose edges are 2^-(depth + 1) of the region's")
      .at_least(0)
      .at_most(Octree::kMostLevels - 1);
  s.field("narrowing_iterations", &S::narrowing_iterations,
          "Number of training iterations that narrow the density to true focal points: the last "
          "ones, and at most a third of all")
      .at_least(0);
  s.field("burn_in", &S::burn_in,
          "Number of iterations after which all others narrow the density, instead of the last "
          "`narrowing_iterations`")
      .at_least(0);
  s.field("catch_up", &S::catch_up,
          "Greatest number of iterations to catch up with. The learner counts the iterations with "
          "too little light, from the last one before narrowing on. Once an iteration has enough "
          "light, its segments narrow the density again, once for each of them (paper: 0). Needs "
          "`narrowing_decay: 0`")
      .at_least(0)
      .at_most(64);
  s.field("least_segments", &S::least_segments,
          "Number of equally bright segments that an iteration must be worth to have enough light")
      .at_least(1);
  s.field("caught_up_share", &S::caught_up_share,
          "Least share of guided samples that is assumed for segments when they narrow the density "
          "again")
      .above(0)
      .at_most(1);
  s.field("kept_segments", &S::kept_segments,
          "Number of segments of an iteration that are kept to catch up")
      .at_least(64)
      .at_most(1u << 20);
  s.field("splat_extent", &S::splat_extent,
          "Where a path adds mass: along the whole line of each segment (paper), or only along the "
          "segment itself unless its end is nearly specular (authors' code)");
  s.field("glossy_roughness", &S::glossy_roughness,
          "For `roughness_gated`: roughness below which the end of a segment is nearly specular")
      .at_least(0)
      .at_most(1);
  s.field("splat_weight", &S::splat_weight,
          "Weight of a contribution in a cell before narrowing: the length within the cell "
          "(paper), or the cell's share of the splatted length (authors' code)");
  s.field("decay", &S::decay,
          "Factor on the masses of earlier iterations: 0 (paper), 0.5 (authors' code)")
      .at_least(0)
      .below(1);
  s.field("narrowing_decay", &S::narrowing_decay,
          "The same factor once narrowing has begun: 0 (paper), 0.25 (authors' code)")
      .at_least(0)
      .below(1);
  s.field(
      "mis_compensation", &S::mis_compensation,
      "MIS compensation while narrowing: the density leaves to BSDF sampling what it samples well");
  s.field("prune_ratio", &S::prune_ratio,
          "After training, a node becomes a leaf if none of its leaves is denser than this many "
          "times their mean; 0 keeps all nodes")
      .at_least(0);
  s.field("local_cells", &S::local_cells,
          "Number of cells of space along each axis of the region. In each cell, the parts of the "
          "region have weights of their own, so that points behind a wall lose their mass there "
          "(paper: 1, the same density everywhere)")
      .at_least(1)
      .at_most(8);
  s.field("local_prior", &S::local_prior,
          "Effective number of segments for which the density of the whole scene counts in a cell "
          "of space")
      .above(0);
  s.example("{ burn_in: 1, local_cells: 2 }");
}

FocalLearner::FocalLearner(const Settings& settings) : settings_(settings) {
  if (settings.catch_up > 0 && settings.narrowing_decay > 0) {
    throw InputError("`catch_up` needs `narrowing_decay: 0`");
  }
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
