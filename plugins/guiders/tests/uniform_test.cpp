#include <cmath>
#include <sstream>

#include <doctest/doctest.h>

#include <pharos/conformance/stage.h>
#include <pharos/core/binary_stream.h>

#include "../uniform_guider.h"
#include "../uniform_learner.h"
#include "../uniform_model.h"

namespace pharos {
namespace {

/// A path that goes on from one vertex on a wall, where it may be guided or not, and meets a lamp.
PathLog path_to_lamp(float radiance, bool guidable = true) {
  PathLog log;
  log.begin_path({}, Transport::radiance);
  log.add(RecordedVertex{.kind = VertexKind::sensor, .local_weight = Rgb(1)});
  log.add(RecordedVertex{.parent = 0, .local_weight = Rgb(0.5f), .guidable = guidable});
  log.add(RecordedVertex{.parent = 1, .emission = Rgb(radiance)});
  return log;
}

double radiance_of(LearningState& state) {
  return state.update(0, true)->density({1, 2, 3});
}

}  // namespace

TEST_CASE("uniform: learns the mean radiance that guidable steps met, of each iteration anew") {
  const auto state = UniformLearner().begin({});
  CHECK(state->initial_model() == nullptr);
  for (const float radiance : {6.0f, 0.0f, 3.0f}) state->absorb(path_to_lamp(radiance));
  state->absorb(path_to_lamp(100, false));
  CHECK(radiance_of(*state) == doctest::Approx(3));
  state->absorb(path_to_lamp(5));
  CHECK(radiance_of(*state) == doctest::Approx(5));
  CHECK(radiance_of(*state) == 0);
}

TEST_CASE("uniform: a saved state goes on where it stopped") {
  const auto first = UniformLearner().begin({}), second = UniformLearner().begin({});
  first->absorb(path_to_lamp(6));
  std::stringstream file;
  first->save(file);
  second->absorb(path_to_lamp(99));
  second->load(file);
  second->absorb(path_to_lamp(2));
  CHECK(radiance_of(*second) == doctest::Approx(4));
  CHECK_THROWS_AS(second->load(file), InputError);
}

TEST_CASE("uniform: merging adds what was absorbed since the last update") {
  const auto first = UniformLearner().begin({}), second = UniformLearner().begin({});
  for (const auto* state : {&first, &second}) {
    (*state)->absorb(path_to_lamp(100));
    (*state)->update(0, false);
  }
  first->absorb(path_to_lamp(6));
  second->absorb(path_to_lamp(0));
  second->absorb(path_to_lamp(3));
  first->merge(*second);
  CHECK(radiance_of(*first) == doctest::Approx(3));
}

TEST_CASE("uniform: models are saved with a version that is checked") {
  std::stringstream file;
  UniformModel(0.7).save(file);
  CHECK(UniformLearner().load_model(file)->density({}, {0, 0, 1}) == 0.7);

  std::stringstream newer;
  save_heading(newer, UniformModel::kName, UniformModel::kVersion + 1);
  save_number(newer, 0.7);
  CHECK_THROWS_AS(UniformLearner().load_model(newer), InputError);
  std::stringstream damaged;
  UniformModel(NAN).save(damaged);
  CHECK_THROWS_AS(UniformLearner().load_model(damaged), InputError);
}

TEST_CASE("uniform: the guider declines while no light was met") {
  const SurfacePoint point;
  const Ref<Bsdf> bsdf = conformance::black_bsdf();
  const LocalScattering scattering(point, *bsdf, {0, 0, 1}, Transport::radiance);
  const GuidingQuery query{.scattering = scattering};
  for (const double radiance : {0.0, 0.5}) {
    Arena arena;
    const auto bound = UniformGuider().bind(std::make_shared<UniformModel>(radiance));
    CHECK((bound->query(query, arena) != nullptr) == (radiance > 0));
  }
}

TEST_CASE("uniform: the guider takes the learner's model and no other") {
  class OtherModel final : public GuidingModel {
   public:
    std::string name() const override { return "other"; }
    std::uint32_t version() const override { return 1; }
    std::size_t size_bytes() const override { return 0; }
    void save(std::ostream&) const override {}
    double density(Point3) const override { return 1; }
    double density(Point3, Vec3) const override { return 1; }
  };
  const UniformGuider guider;
  CHECK(guider.traits().model == UniformLearner().traits().model);
  CHECK(guider.bind(std::make_shared<UniformModel>(1)) != nullptr);
  CHECK_THROWS_WITH_AS(guider.bind(std::make_shared<OtherModel>()),
                       doctest::Contains("cannot sample the model 'other'"), InputError);
}

}  // namespace pharos
