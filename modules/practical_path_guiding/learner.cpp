#include "learner.h"

#include "learning_state.h"
#include "model.h"

namespace pharos::practical_path_guiding {

void PracticalPathGuidingSettings::describe(Schema<PracticalPathGuidingSettings>& s) {
  using S = PracticalPathGuidingSettings;
  s.field("spatial_threshold", &S::spatial_threshold,
          "A cell is halved if its records in an iteration exceed this number times the square "
          "root of a quarter of the iteration's samples per pixel (c)")
      .at_least(10);
  s.field("spatial_depth", &S::spatial_depth, "Maximum number of dividing planes above a cell")
      .at_least(0)
      .at_most(KdTree::kMostLevels);
  s.field("by_facing", &S::by_facing,
          "Whether surfaces in a cell learn apart if their normals lie along different axes, or "
          "point different ways along one");
  s.field(
       "directional_threshold", &S::directional_threshold,
       "Share of the cell's flux above which a quarter of the quadtree's square is divided (rho)")
      .at_least(1e-4)
      .at_most(1);
  s.field("directional_depth", &S::directional_depth, "Maximum number of quadtree levels")
      .at_least(1)
      .at_most(QuadDensity::kMostLevels);
  s.field("spatial_filter", &S::spatial_filter,
          "Cell that receives a record: the one at its position, or the one at a random point in a "
          "box of that cell's size around it");
  s.field("directional_filter", &S::directional_filter,
          "Leaves of the quadtree that receive a record: the one at its direction, or all that "
          "overlap a box of that leaf's size around it");
  s.field("target", &S::target,
          "Quantity that the sampling density is proportional to: incident radiance, or the root "
          "of the second moment of reflected radiance (`product`) or of the contribution relative "
          "to the pixel (`relative`, variance-aware)");
  s.field(
      "light_hits", &S::light_hits,
      "What steps learn that hit a light which light samples also reach: the light with its MIS "
      "weight (`weighted`), or nothing (`left_out`)");
  s.field("memory", &S::memory,
          "Part of the sums in the trees that stays for the next iteration. 0: every iteration "
          "begins anew, 1: all samples count alike")
      .at_least(0)
      .at_most(1);
  s.field("spatial_prior", &S::spatial_prior,
          "Number of records for which the light of the next larger cell counts. 0: every cell "
          "knows its own light only")
      .at_least(0)
      .at_most(1e6);
  s.field("directional_prior", &S::directional_prior,
          "Number of records that are spread evenly over the quarters of every square of the "
          "quadtree, besides those that it received. They have the value of the cell's light "
          "divided by its effective number of records")
      .at_least(0)
      .at_most(1e6);
  s.field(
       "pixel_radius", &S::pixel_radius,
       "For `relative`: pixel values are averaged over pixels up to this far away along both axes")
      .at_least(0)
      .at_most(16);
  s.field("least_pixel", &S::least_pixel,
          "For `relative`: lower bound of the pixel values, relative to the mean of the image")
      .above(0);
  s.field("batch_records", &S::batch_records,
          "Number of waiting records (32 bytes each) at which they are added to the trees before "
          "the iteration ends")
      .at_least(1024);
  s.example("{ target: product, spatial_filter: nearest, directional_filter: nearest }");
  s.example("{ target: relative, spatial_threshold: 500, by_facing: true }");
}

LearnerTraits PracticalPathGuidingLearner::traits() const {
  return {.records = {.light_samples = true}};
}

std::unique_ptr<LearningState> PracticalPathGuidingLearner::begin(
    const LearningContext& context) const {
  return std::make_unique<PracticalPathGuidingLearningState>(settings_, context);
}

std::shared_ptr<GuidingModel> PracticalPathGuidingLearner::empty_model() const {
  const bool of_radiance = settings_.target == GuidingTarget::radiance;
  const Cells cells{.space = {}, .by_facing = settings_.by_facing};
  return std::make_shared<PracticalPathGuidingModel>(
      cells, std::vector<PracticalPathGuidingModel::Cell>(cells.count()), of_radiance);
}

}  // namespace pharos::practical_path_guiding
