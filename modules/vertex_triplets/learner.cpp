#include "learner.h"

#include <pharos/core/error.h>

#include "learning_state.h"
#include "model.h"

namespace pharos::vertex_triplets {

void VertexTripletsSettings::describe(Schema<VertexTripletsSettings>& s) {
  using S = VertexTripletsSettings;
  s.field(
      "vertices", &S::vertices,
      "Vertices that mixtures are over: the current and the next one, or also the previous one");
  s.field("light_paths", &S::light_paths,
          "Also learn from paths from lights and guide them, if the integrator traces such paths; "
          "for `triplets` only");
  s.field("cells", &S::cells, "Approximate number of cells of the octree")
      .at_least(1)
      .at_most(1u << 16);
  s.field("components", &S::components,
          "Maximum number of Gaussians for each light transport mode of a cell")
      .at_least(1)
      .at_most(1024);
  s.field("reservoir", &S::reservoir, "Maximum number of samples that a cell keeps")
      .at_least(8)
      .at_most(1u << 20);
  s.field("least_effective", &S::least_effective,
          "A cell is divided only if it keeps effectively more samples (Kish) than this; cells are "
          "then also compared by this number. 0: they are compared by plain counts of new samples")
      .at_least(0);
  s.field("jitter", &S::jitter,
          "Edge of the box in which a sample's position is jittered to choose its cell, relative "
          "to the edge of the sample's own cell")
      .at_least(0)
      .at_most(2);
  s.field("single_deviation", &S::single_deviation,
          "Standard deviation of a Gaussian that is fitted to a single sample, relative to the "
          "edge of its cell; in radians for the environment")
      .above(0);
  s.field("least_deviation", &S::least_deviation,
          "Lower bound of standard deviations, in the same units")
      .above(0);
  s.field("em_iterations", &S::em_iterations, "Maximum number of steps of a fit").at_least(1);
  s.field("em_tolerance", &S::em_tolerance,
          "A fit ends if a step changes the mean logarithm of the density by less than this share "
          "of it")
      .at_least(0);
  s.field("environment_distance", &S::environment_distance,
          "Distance at which the environment is placed, relative to the diagonal of the scene")
      .above(0);
  s.field(
       "inherit", &S::inherit,
       "Number of effective samples for which the mixture of a divided cell counts in the fits of "
       "its parts. 0: parts are fitted to their own samples alone")
      .at_least(0);
  s.field("translation", &S::translation,
          "Expect paths that are parallel to a single sample: its vertices also get a shift in "
          "common, by as much as points of the cell differ");
  s.field("light_samples", &S::light_samples,
          "Learn the way to the lights that next event estimation samples; if false, only from "
          "what steps hit and from the light that arrives at the vertices after it");
  s.field("weights", &S::weights,
          "Weights of samples: the path's part of the image; only the part of the path after the "
          "sample's first two vertices (`suffix`); or the path's part of its pixel (`relative`). "
          "With `light_paths` only `path`");
  s.field(
       "pixel_radius", &S::pixel_radius,
       "For `relative`: pixel values are averaged over pixels up to this far away along both axes")
      .at_least(0)
      .at_most(16);
  s.field("least_pixel", &S::least_pixel,
          "For `relative`: lower bound of the pixel values, relative to the mean of the image")
      .above(0);
  s.example("{ vertices: pairs }");
  s.example("{ inherit: 10, translation: true, light_samples: false, weights: suffix }");
  s.example("{ weights: relative }");
}

VertexTripletsLearner::VertexTripletsLearner(const Settings& settings) : settings_(settings) {
  if (settings.light_paths && settings.vertices == Prefix::pair) {
    throw InputError("'light_paths' needs 'vertices: triplets': pairs know one way only");
  }
  if (settings.light_paths && settings.weights != SampleWeights::path) {
    throw InputError(
        "'light_paths' needs 'weights: path': only these weights are comparable between paths from "
        "both ends");
  }
}

LearnerTraits VertexTripletsLearner::traits() const {
  return {.records = {.light_samples = true, .light_paths = settings_.light_paths}};
}

std::unique_ptr<LearningState> VertexTripletsLearner::begin(const LearningContext& context) const {
  return std::make_unique<VertexTripletsLearningState>(settings_, context);
}

std::shared_ptr<GuidingModel> VertexTripletsLearner::empty_model() const {
  return std::make_shared<VertexTripletsModel>();
}

}  // namespace pharos::vertex_triplets
