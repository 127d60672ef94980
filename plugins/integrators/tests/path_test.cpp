// Tests that need no scene. Renders are tested in tests/integration and tests/contracts.

#include "../path.h"

#include <array>

#include <doctest/doctest.h>

#include <pharos/core/error.h>
#include <pharos/guiding/toolkit/throughput_roulette.h>
#include <pharos/transport/path_text.h>

namespace pharos {
namespace {

TEST_CASE("MIS weights of all techniques sum to one") {
  using enum MisHeuristic;
  for (const MisHeuristic heuristic : {balance, power, light_samples}) {
    for (const auto& [a, b] : {std::pair{1.0f, 1.0f}, {0.1f, 30.0f}, {1e25f, 2e25f}}) {
      const float sum = light_sample_weight(heuristic, a, b) + emission_weight(heuristic, b, a);
      CHECK(sum == doctest::Approx(1));
    }
    CHECK(light_sample_weight(heuristic, 2, 0) == 1);
    CHECK(emission_weight(heuristic, 2, 0) == 1);
  }
  CHECK(emission_weight(balance, 1, 3) == doctest::Approx(0.25));
  CHECK(light_sample_weight(power, 1, 3) == doctest::Approx(0.1));
  CHECK(emission_weight(light_samples, 1e6f, 1e-6f) == 0);
}

TEST_CASE("path offers what guides need, and no guiding unless asked") {
  const PathIntegrator path({});
  CHECK(path.guiding() == nullptr);
  CHECK(path.traits().guided);
  CHECK(path.traits().guided_camera);
  CHECK(path.traits().records.light_samples);
  CHECK_FALSE(path.traits().records.light_paths);
}

class IdleModel final : public GuidingModel {
 public:
  static constexpr std::string_view kName = "none";
  ModelInfo info() const override { return {.name = std::string(kName)}; }
  void archive(Archive&) override {}
  double density(Point3, const Vec3*) const override { return 0; }
};

class IdleLearner final : public Learner {
 public:
  explicit IdleLearner(RecordNeeds needs = {}) : needs_(needs) {}
  LearnerTraits traits() const override { return {.records = needs_}; }
  std::unique_ptr<LearningState> begin(const LearningContext&) const override { return nullptr; }
  std::shared_ptr<GuidingModel> empty_model() const override {
    return std::make_shared<IdleModel>();
  }

 private:
  RecordNeeds needs_;
};

class IdleGuider final : public GuiderOf<IdleModel> {
 public:
  explicit IdleGuider(bool guides_camera) : guides_camera_(guides_camera) {}
  GuiderTraits traits() const override { return {.guides_camera = guides_camera_}; }
  const GuidingDistribution* query(const IdleModel&, const GuidingQuery&, Arena&) const override {
    return nullptr;
  }

 private:
  bool guides_camera_;
};

class StubSensor final : public Sensor {
 public:
  explicit StubSensor(bool one_direction) : one_direction_(one_direction) {}
  std::unique_ptr<const PreparedSensor> prepare(int, int) const override { return nullptr; }
  bool sees_one_direction() const override { return one_direction_; }
  Point3 position() const override { return {}; }

 private:
  bool one_direction_;
};

TEST_CASE("guides of the camera are refused where paths cannot go where they want") {
  const auto message = [](bool guides_camera, bool one_direction,
                          bool jitter = true) -> std::string {
    PathSettings settings;
    settings.guiding.emplace();
    settings.guiding->learner = std::make_shared<const IdleLearner>();
    settings.guiding->guider = std::make_shared<const IdleGuider>(guides_camera);
    try {
      check_compatible(PathIntegrator(settings), StubSensor(one_direction), jitter);
    } catch (const InputError& error) {
      return error.what();
    }
    return "fits";
  };
  CHECK(message(true, true).find("sees a single direction") != std::string::npos);
  CHECK(message(true, false, false).find("middles of pixels") != std::string::npos);
  CHECK(message(true, false) == "fits");
  CHECK(message(false, false, false) == "fits");
  CHECK(message(false, true) == "fits");
}

TEST_CASE("what a learner needs recorded must be offered, unless it has its model already") {
  PathSettings settings;
  settings.guiding.emplace();
  settings.guiding->learner = std::make_shared<const IdleLearner>(RecordNeeds{.light_paths = true});
  settings.guiding->guider = std::make_shared<const IdleGuider>(false);
  const StubSensor sensor(false);
  CHECK_THROWS_WITH_AS(check_compatible(PathIntegrator(settings), sensor),
                       doctest::Contains("needs light paths"), InputError);
  settings.guiding->model = std::make_shared<const IdleModel>();
  CHECK_NOTHROW(check_compatible(PathIntegrator(settings), sensor));
}

TEST_CASE("a path's text tells of every vertex, technique and light sample") {
  PathLog log;
  log.begin_path({1.5f, 2.5f}, Transport::radiance);
  log.add(RecordedVertex{.kind = VertexKind::sensor, .event = Event::smooth_reflect});
  log.set_techniques(0, std::array{Technique{0.25f, 0.5f}, Technique{0.75f, 6}});
  log.add(RecordedVertex{.kind = VertexKind::surface, .event = Event::discrete_transmit});
  log.add(RecordedVertex{.kind = VertexKind::environment, .emission = Rgb(3)});
  log.add(RecordedLightSample{.vertex = 1, .contribution = Rgb(0.5f)});
  const std::string text = path_text(log[0], Rgb(1));
  for (const char* word : {"0 sensor", "1 surface", "2 environment", "discrete transmit",
                           "emission (3, 3, 3)", "light sample", "film (1.5000, 2.5000)",
                           "share 0.25 of unguided 0.5, 0.75 of method 1 6"}) {
    CHECK_MESSAGE(text.find(word) != std::string::npos, word);
  }
}

TEST_CASE("a path's text names its branches and the end by roulette") {
  PathLog log;
  log.begin_path({}, Transport::radiance);
  log.add(RecordedVertex{.kind = VertexKind::sensor, .event = Event::smooth_reflect});
  log.add(RecordedVertex{.event = Event::smooth_reflect, .parent = 0, .continuation = 0.5f});
  log.add(RecordedVertex{
      .event = Event::smooth_reflect, .parent = 0, .continuation = 0.5f, .branch = 1});
  log.add(RecordedVertex{.parent = 1, .continuation = 0});
  log.add(RecordedVertex{.kind = VertexKind::environment, .parent = 2, .branch = 1});
  const std::string text = path_text(log[0], Rgb(1));
  for (const char* words : {"branch 1 after 0", "branch 0 after 1", "branch 1 after 2",
                            "      roulette\n", "      end\n"}) {
    CHECK_MESSAGE(text.find(words) != std::string::npos, words);
  }
}

TEST_CASE("settings of terminations that contradict each other are refused") {
  class Fixed final : public Termination {
   public:
    explicit Fixed(bool learns) : learns_(learns) {}
    bool learns() const override { return learns_; }
    std::unique_ptr<TerminationState> begin(const LearningContext&) const override {
      return std::make_unique<FixedTermination>(nullptr);
    }

   private:
    bool learns_;
  };
  PathSettings settings;
  settings.termination = std::make_shared<const Fixed>(true);
  settings.training.emplace();
  CHECK_NOTHROW(PathIntegrator{settings});
  settings.training->tolerance = 0.1;
  CHECK_THROWS_WITH_AS(PathIntegrator{settings}, doctest::Contains("no guide learns"), InputError);
  settings.training.reset();
  settings.termination = std::make_shared<const Fixed>(false);
  CHECK_NOTHROW(PathIntegrator{settings});
  settings.training.emplace();
  CHECK_THROWS_WITH_AS(PathIntegrator{settings}, doctest::Contains("nothing learns"), InputError);
  settings.training.reset();
  settings.roulette = Roulette::throughput;
  CHECK_THROWS_WITH_AS(PathIntegrator{settings}, doctest::Contains("'roulette' must be off"),
                       InputError);
}

}  // namespace
}  // namespace pharos
