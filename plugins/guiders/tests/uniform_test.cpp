#include <cmath>
#include <sstream>

#include <doctest/doctest.h>

#include <pharos/conformance/guided.h>
#include <pharos/conformance/stage.h>

#include "../uniform_guider.h"
#include "../uniform_learner.h"
#include "../uniform_model.h"

namespace pharos {
namespace {

/// Returns a path that continues from one vertex on a wall, guidable or not, and hits a lamp.
PathLog path_to_lamp(float radiance, bool guidable = true) {
  PathLog log;
  log.begin_path({}, Transport::radiance);
  log.add(RecordedVertex{.kind = VertexKind::sensor, .local_weight = Rgb(1)});
  log.add(RecordedVertex{.guidable = guidable, .parent = 0, .local_weight = Rgb(0.5f)});
  log.add(RecordedVertex{.parent = 1, .emission = Rgb(radiance)});
  return log;
}

double radiance_of(LearningState& state) {
  return state.update({0, 0}).model->density({1, 2, 3});
}

}  // namespace

TEST_CASE("uniform: learns the mean radiance that guidable steps met, of each iteration anew") {
  const auto state = UniformLearner().begin({});
  for (const float radiance : {6.0f, 0.0f, 3.0f}) state->absorb(path_to_lamp(radiance));
  state->absorb(path_to_lamp(100, false));
  CHECK(radiance_of(*state) == doctest::Approx(3));
  state->absorb(path_to_lamp(5));
  CHECK(radiance_of(*state) == doctest::Approx(5));
  CHECK(radiance_of(*state) == 0);
}

TEST_CASE("uniform: the branches of a vertex count for one step, and survivors for all") {
  const auto state = UniformLearner().begin({});
  PathLog split;
  split.begin_path({}, Transport::radiance);
  split.add(RecordedVertex{.kind = VertexKind::sensor, .local_weight = Rgb(1)});
  for (int i = 0; i < 2; ++i) {
    split.add(RecordedVertex{.guidable = true, .parent = 0, .continuation = 0.5f});
  }
  split.add(RecordedVertex{.parent = 1, .emission = Rgb(2)});
  split.add(RecordedVertex{.parent = 2, .emission = Rgb(6)});
  state->absorb(split);
  state->absorb(path_to_lamp(1));
  CHECK(radiance_of(*state) == doctest::Approx((4 + 1) / 2.0));

  PathLog survivor = path_to_lamp(3), ended = path_to_lamp(0);
  survivor.vertex(1).continuation = 4;
  ended.vertex(1).continuation = 0;
  state->absorb(survivor);
  for (int i = 0; i < 3; ++i) state->absorb(ended);
  CHECK(radiance_of(*state) == doctest::Approx(3));
}

TEST_CASE("uniform: a saved state goes on where it stopped") {
  const auto first = UniformLearner().begin({}), second = UniformLearner().begin({});
  first->absorb(path_to_lamp(6));
  std::stringstream file;
  save(file, *first);
  second->absorb(path_to_lamp(99));
  load(file, *second);
  second->absorb(path_to_lamp(2));
  CHECK(radiance_of(*second) == doctest::Approx(4));
  CHECK_THROWS_AS(load(file, *second), InputError);
}

TEST_CASE("uniform: models are loaded as they were saved, and damaged ones are refused") {
  const auto loaded = [](double radiance) {
    std::stringstream file;
    save(file, UniformModel(radiance));
    const auto model = UniformLearner().empty_model();
    load(file, *model);
    return model;
  };
  const Vec3 up{0, 0, 1};
  CHECK(loaded(0.7)->density({}, &up) == 0.7);
  CHECK_THROWS_AS(loaded(NAN), InputError);
  CHECK_THROWS_AS(loaded(-1), InputError);
}

TEST_CASE("uniform: the guide is asked only once light was met") {
  const SurfacePoint point;
  const Ref<Bsdf> bsdf = conformance::black_bsdf();
  const LocalScattering scattering(point, *bsdf, {0, 0, 1}, Transport::radiance);
  const UniformGuider guider;
  for (const double radiance : {0.0, 0.5}) {
    Arena arena;
    GuidingQuery query{.scattering = &scattering};
    const auto frame = conformance::frame_of(guider, std::make_shared<UniformModel>(radiance));
    CHECK(frame.query(query, arena).is_guided() == (radiance > 0));
  }
}

TEST_CASE("uniform: the guider takes the learner's model and no other") {
  class OtherModel final : public GuidingModel {
   public:
    ModelInfo info() const override { return {.name = "other"}; }
    void archive(Archive&) override {}
    double density(Point3, const Vec3*) const override { return 1; }
  };
  const UniformGuider guider;
  CHECK(guider.model_name() == UniformLearner().empty_model()->info().name);
  CHECK(guider.find(*UniformLearner().empty_model()) != nullptr);
  CHECK_NOTHROW(BoundGuider(guider, std::make_shared<UniformModel>(1)));
  CHECK_THROWS_WITH_AS(BoundGuider(guider, std::make_shared<OtherModel>()),
                       doctest::Contains("cannot sample the model 'other'"), InputError);
}

}  // namespace pharos
