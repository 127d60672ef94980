// Tests of model files. A method with a model file guides from the start and learns nothing.

#include <cmath>
#include <filesystem>
#include <sstream>
#include <unistd.h>

#include <pharos/guiding/pipeline/model_file.h>

#include "furnace.h"

namespace pharos::testing {
namespace {

/// The file of a model that a render of the furnace has learned.
class LearnedFile {
 public:
  LearnedFile(const std::string& learner, const std::string& guider)
      : path_(std::filesystem::temp_directory_path() /
              fmt::format("pharos-{}-{}.model", guider, getpid())) {
    const std::string guiding = fmt::format(
        "{{ learner: {}, guider: {}, training: {{ iterations: 3 }} }}", learner, guider);
    const RenderResult result = render(path_config(kDiffuseScene, 4, guiding, 32));
    write_model_file(*result.learned, path_);
  }
  ~LearnedFile() { std::filesystem::remove(path_); }
  LearnedFile(const LearnedFile&) = delete;
  LearnedFile& operator=(const LearnedFile&) = delete;

  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

/// Returns `guiding` settings that load the model from a file. Their training must not take place.
std::string fixed(const std::string& name, const std::string& file, const std::string& more = "") {
  return fmt::format("{{ learner: {}, guider: {}, model: '{}', {}training: {{ iterations: 3 }} }}",
                     name, name, file, more);
}

std::string bits(const Image& image) {
  const std::vector<float>& values = image.values();
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)};
}

std::string bits(const GuidingModel& model) {
  std::ostringstream out;
  save(out, model);
  return out.str();
}

TEST_CASE("a render with a model file: its model, no training, the whole budget") {
  const LearnedFile file("stub_direction", "stub_direction");
  const LoadedConfig loaded =
      config_from(path_config(kDiffuseScene, 4, fixed("stub_direction", file.path()), 24));
  const GuidingSettings& guiding = *loaded.config.integrator->guiding();
  CHECK_FALSE(guiding.learns());
  bool trained = false;
  std::uint32_t iterations = 0;
  RenderControl control;
  control.on_progress = [&](const Progress& progress) {
    trained |= progress.training;
    iterations = std::max(iterations, progress.iteration_count);
  };
  const RenderResult result = RenderJob(loaded.config).run(control);
  CHECK_FALSE(trained);
  CHECK(iterations == 1);
  CHECK(result.times.training == 0);
  CHECK(result.samples_per_pixel == 24);
  CHECK(result.learned->models.at(0).learner == "stub_direction");
  CHECK(bits(*result.model) == bits(*guiding.model));
  // The model guides paths. Without guiding, the same paths would give the same bits.
  const RenderResult unguided = render(path_config(kDiffuseScene, 4, "", 24));
  CHECK(bits(unguided.image) != bits(result.image));
}

TEST_CASE("renders with a model file: the same bits for any number of threads") {
  const LearnedFile file("{ type: stub_direction, refine: true }", "stub_direction");
  const std::string config =
      path_config(kDiffuseScene, 4, fixed("stub_direction", file.path(), "mixing: stub_learned, "),
                  16, "sobol");
  const std::string once = bits(render(config, 1).image);
  CHECK(bits(render(config, 1).image) == once);
  CHECK(bits(render(config, 3).image) == once);
}

TEST_CASE("furnace: model files") {
  for (const char* name : {"stub_direction", "stub_segments", "stub_vertices", "stub_camera"}) {
    CAPTURE(name);
    const LearnedFile file(name, name);
    const std::string config = path_config(kDiffuseScene, 4, fixed(name, file.path()), 32);
    CHECK(std::abs(furnace_t(config, kDiffuseFurnace)) < kLimit);
  }
}

TEST_CASE("furnace: a method with a model file beside one that learns") {
  const LearnedFile file("{ type: stub_direction, refine: true }", "stub_direction");
  const std::string guiding = fmt::format(
      "{{ methods: [ {{ learner: stub_direction, guider: stub_direction, model: '{}' }}, "
      "{{ learner: {{ type: stub_direction, refine: true }}, guider: stub_direction }} ], "
      "mixing: stub_learned, training: {{ iterations: 3 }} }}",
      file.path());
  const std::string config = path_config(kDiffuseScene, 4, guiding, 32);
  CHECK(std::abs(furnace_t(config, kDiffuseFurnace)) < kLimit);
  const LoadedConfig loaded = config_from(config);
  CHECK(loaded.config.integrator->guiding()->learns());
  const RenderResult result = RenderJob(loaded.config).run();
  CHECK(result.times.training > 0);
  // Training has not changed the model.
  CHECK(bits(*result.model) == bits(*loaded.config.integrator->guiding()->methods[0].model));
}

TEST_CASE("furnace: two methods that share the model of a file") {
  const LearnedFile file("stub_direction", "stub_direction");
  const std::string guiding = fmt::format(
      "{{ methods: [ {{ learner: stub_direction, guider: stub_direction, model: '{}' }}, "
      "{{ guider: {{ type: stub_direction, adversarial: true }} }} ] }}",
      file.path());
  const std::string config = path_config(kDiffuseScene, 4, guiding, 32);
  CHECK_FALSE(config_from(config).config.integrator->guiding()->learns());
  CHECK(std::abs(furnace_t(config, kDiffuseFurnace)) < kLimit);
}

TEST_CASE("furnace: a file with two models and what their mixing has learned") {
  const auto guiding = [](const std::string& more) {
    return "{ methods: [ { learner: stub_direction, guider: stub_direction, weight: 2 }, { "
           "learner: "
           "{ type: stub_direction, refine: true }, guider: stub_direction } ], training: { "
           "iterations: 3 }, " +
           more + " }";
  };
  const auto config = [&](const std::string& more) {
    return path_config(kDiffuseScene, 4, guiding(more), 32);
  };
  const RenderResult trained = render(config("mixing: simplex"));
  REQUIRE(trained.learned != nullptr);
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / fmt::format("pharos-two-{}.model", getpid());
  write_model_file(*trained.learned, path);
  const std::string again = fmt::format("mixing: simplex, model: '{}'", path.string());
  const LoadedConfig loaded = config_from(config(again));
  const GuidingSettings& settings = *loaded.config.integrator->guiding();
  CHECK_FALSE(settings.learns());
  CHECK(settings.mixing_state == trained.learned->mixing_state);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(bits(*settings.methods[i].model) == bits(*trained.learned->models[i].model));
  }
  const RenderResult result = RenderJob(loaded.config).run();
  CHECK(result.learned->mixing_state == trained.learned->mixing_state);
  CHECK(std::abs(furnace_t(config(again), kDiffuseFurnace)) < kLimit);
  // Another policy has not learned this.
  const LoadedConfig other =
      config_from(config(fmt::format("mixing: fixed, model: '{}'", path.string())));
  CHECK(other.config.integrator->guiding()->mixing_state.empty());
  const LoadedConfig changed = config_from(config(
      fmt::format("mixing: {{ type: simplex, cell_steps: 99 }}, model: '{}'", path.string())));
  CHECK(changed.config.integrator->guiding()->mixing_state.empty());
  LearnedGuiding damaged = *trained.learned;
  damaged.mixing_state.resize(damaged.mixing_state.size() / 2);
  write_model_file(damaged, path);
  CHECK_THROWS_WITH_AS(
      config_from(config(again)),
      doctest::Contains(fmt::format("the model file '{}' cannot be read: ", path.string()).c_str()),
      InputError);
  damaged.mixing_state = trained.learned->mixing_state + "more";
  write_model_file(damaged, path);
  CHECK_THROWS_WITH_AS(config_from(config(again)),
                       doctest::Contains("holds more than its policy has learned"), InputError);
  std::filesystem::remove(path);
}

TEST_CASE("a model file that is wrong is told of where the config names it") {
  const LearnedFile file("stub_direction", "stub_direction");
  CHECK_THROWS_WITH_AS(
      config_from(path_config(kDiffuseScene, 4, fixed("stub_segments", file.path()), 1)),
      doctest::Contains(("was learned by 'stub_direction', which the learner 'stub_segments' "
                         "cannot read")),
      InputError);
  CHECK_THROWS_WITH_AS(config_from(path_config(kDiffuseScene, 4, "{ model: x }", 1)),
                       doctest::Contains("guiding has no learner"), InputError);
}

}  // namespace
}  // namespace pharos::testing
