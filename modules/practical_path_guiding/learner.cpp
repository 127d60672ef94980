#include "learner.h"

#include "learning_state.h"
#include "model.h"

namespace pharos::practical_path_guiding {

void PracticalPathGuidingSettings::describe(Schema<PracticalPathGuidingSettings>& s) {
  using S = PracticalPathGuidingSettings;
  s.field("spatial_threshold", &S::spatial_threshold,
          "Records of an iteration, over the square root of half its samples a pixel, above which "
          "a cell is halved (c)")
      .at_least(10);
  s.field("spatial_depth", &S::spatial_depth, "Planes above the smallest cell at most")
      .at_least(0)
      .at_most(KdTree::kMostLevels);
  s.field("directional_threshold", &S::directional_threshold,
          "Share of a cell's light above which a quarter of its directions is divided (rho)")
      .at_least(1e-4)
      .at_most(1);
  s.field("directional_depth", &S::directional_depth, "Levels of quarters at most")
      .at_least(1)
      .at_most(QuadDensity::kMostLevels);
  s.field("spatial_filter", &S::spatial_filter,
          "Which cell learns from a record: its own, or one at random around it");
  s.field("directional_filter", &S::directional_filter,
          "Which leaves of directions do: the one it lies in, or those in a box around it");
  s.field("target", &S::target,
          "What is sampled in proportion to: incident radiance, or the root of the second moment "
          "of what it contributes to the vertex or, relatively, to the pixel (variance-aware)");
  s.field("pixel_radius", &S::pixel_radius,
          "For the relative target: pixels are averaged with those up to so far away")
      .at_least(0)
      .at_most(16);
  s.field("least_pixel", &S::least_pixel,
          "For the relative target: no pixel counts as darker, relative to the image's mean")
      .above(0);
  s.field("batch_records", &S::batch_records,
          "Records that wait at most (24 bytes each) before they are added to the trees")
      .at_least(1024);
  s.example("{ target: product, spatial_filter: nearest, directional_filter: nearest }");
  s.example("{ target: relative, spatial_threshold: 500 }");
}

LearnerTraits PracticalPathGuidingLearner::traits() const {
  return {.records = {.light_samples = true}};
}

std::unique_ptr<LearningState> PracticalPathGuidingLearner::begin(
    const LearningContext& context) const {
  return std::make_unique<PracticalPathGuidingLearningState>(settings_, context);
}

std::shared_ptr<GuidingModel> PracticalPathGuidingLearner::empty_model() const {
  return std::make_shared<PracticalPathGuidingModel>();
}

}  // namespace pharos::practical_path_guiding
