#include "learner.h"

#include <pharos/core/error.h>

#include "learning_state.h"
#include "model.h"

namespace pharos::vertex_triplets {

void VertexTripletsSettings::describe(Schema<VertexTripletsSettings>& s) {
  using S = VertexTripletsSettings;
  s.field("vertices", &S::vertices,
          "What mixtures are over: a vertex and the next one, or the one before them too");
  s.field("light_paths", &S::light_paths,
          "Learn from paths from lights, and guide them too, where the integrator makes any; for "
          "triplets");
  s.field("cells", &S::cells, "Cells of the octree, about").at_least(1).at_most(1u << 16);
  s.field("components", &S::components, "Gaussians for each mode of a cell at most")
      .at_least(1)
      .at_most(1024);
  s.field("reservoir", &S::reservoir, "Samples that a cell keeps").at_least(8).at_most(1u << 20);
  s.field("jitter", &S::jitter,
          "Edge of the box that the place where a sample is kept is drawn from, relative to its "
          "cell's")
      .at_least(0)
      .at_most(2);
  s.field(
       "single_deviation", &S::single_deviation,
       "Standard deviation that a single sample stands for, relative to the edge of its cell; in "
       "radians for the environment")
      .above(0);
  s.field("least_deviation", &S::least_deviation, "Least standard deviation, in the same units")
      .above(0);
  s.field("em_iterations", &S::em_iterations, "Steps of a fit at most").at_least(1);
  s.field("em_tolerance", &S::em_tolerance,
          "A fit ends when a step changes the mean logarithm of the density by less, relative to "
          "itself")
      .at_least(0);
  s.field("environment_distance", &S::environment_distance,
          "How far away the environment is taken to be, relative to the diagonal of the scene")
      .above(0);
  s.example("{ vertices: pairs }");
}

VertexTripletsLearner::VertexTripletsLearner(const Settings& settings) : settings_(settings) {
  if (settings.light_paths && settings.vertices == Prefix::pair) {
    throw InputError("'light_paths' needs 'vertices: triplets': pairs know one way only");
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
