#include "../learner.h"

#include <cmath>
#include <sstream>

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <pharos/core/error.h>
#include <pharos/core/random.h>
#include <pharos/tests/fixtures.h>

#include "../model.h"
#include "../sample.h"
#include "test_next_vertices.h"

namespace pharos::vertex_triplets {
namespace {

using test::saved;

const SampleRule kRule{.environment = {100}};

std::vector<Sample> samples_of(const PathLog& log, const SampleRule& rule = kRule) {
  std::vector<Sample> samples;
  std::vector<Rgb> incident;
  for (std::size_t i = 0; i < log.size(); ++i) extract_samples(log[i], rule, incident, samples);
  return samples;
}

/// Returns the path lens -> glass -> floor -> environment, with a light sample at the floor.
PathLog path_from_sensor() {
  PathLog log;
  log.begin_path({}, Transport::radiance);
  log.add(RecordedVertex{.position = {0, 0, 5},
                         .kind = VertexKind::sensor,
                         .throughput = Rgb(1),
                         .direction = {0, 0, -1}});
  log.add(RecordedVertex{.position = {0, 0, 1},
                         .event = Event::discrete_transmit,
                         .parent = 0,
                         .throughput = Rgb(2),
                         .local_weight = Rgb(0.5f),
                         .direction = {0, 0, -1},
                         .emission = Rgb(7)});
  log.add(RecordedVertex{.position = {0, 0, 0},
                         .event = Event::smooth_reflect,
                         .parent = 1,
                         .throughput = Rgb(1),
                         .local_weight = Rgb(0.25f),
                         .direction = {0, 1, 0}});
  log.add(RecordedVertex{.position = {0, 55, 0},
                         .kind = VertexKind::environment,
                         .parent = 2,
                         .throughput = Rgb(0.25f),
                         .emission = Rgb(8),
                         .joint_emission = Rgb(4)});
  log.add(RecordedLightSample{.vertex = 2,
                              .position = {3, 0, 1},
                              .kind = VertexKind::surface,
                              .event = Event::smooth_reflect,
                              .direction = {1, 0, 0},
                              .contribution = Rgb(3),
                              .joint_contribution = Rgb(1)});
  return log;
}

TEST_CASE("samples: each triplet once, with all that follows") {
  const std::vector<Sample> samples = samples_of(path_from_sensor());
  REQUIRE(samples.size() == 3);
  // The weight is 2 * 0.5 * (0.25 * 8 + 3).
  CHECK(samples[0].weight == doctest::Approx(5));
  CHECK(samples[0].triplet.mode ==
        Mode{VertexKind::sensor, Event::discrete_transmit, VertexKind::surface});
  CHECK(samples[0].triplet.vertices[0] == Point3{0, 0, 5});
  CHECK(samples[0].triplet.vertices[1] == Point3{0, 0, 1});
  CHECK(samples[0].triplet.vertices[2] == Point3{0, 0, 0});
  CHECK(samples[1].weight == doctest::Approx(2));
  CHECK(samples[1].triplet.mode ==
        Mode{VertexKind::surface, Event::smooth_reflect, VertexKind::environment});
  CHECK(samples[1].triplet.vertices[2] == Point3{0, 100, 0});
  CHECK(samples[2].weight == doctest::Approx(3));
  CHECK(samples[2].triplet.vertices[2] == Point3{3, 0, 1});
}

TEST_CASE("samples: with light paths, weights are those among both ends") {
  SampleRule rule = kRule;
  rule.light_paths = true;
  const std::vector<Sample> samples = samples_of(path_from_sensor(), rule);
  REQUIRE(samples.size() == 3);
  CHECK(samples[0].weight == doctest::Approx(2));  // 2 * 0.5 * (0.25 * 4 + 1)
  CHECK(samples[1].weight == doctest::Approx(1));
  CHECK(samples[2].weight == doctest::Approx(1));
}

/// Returns the path environment -> floor -> wall; the lens sees the floor and the wall.
PathLog path_from_light() {
  PathLog log;
  log.begin_path({}, Transport::importance);
  log.add(RecordedVertex{.position = {9, 9, 9},
                         .kind = VertexKind::environment,
                         .throughput = Rgb(10),
                         .local_weight = Rgb(1),
                         .direction = {0, -1, 0}});
  log.add(RecordedVertex{.position = {1, 0, 0},
                         .event = Event::smooth_reflect,
                         .parent = 0,
                         .throughput = Rgb(10),
                         .local_weight = Rgb(0.5f),
                         .direction = {1, 0, 0}});
  log.add(RecordedVertex{.position = {2, 0, 0}, .parent = 1, .throughput = Rgb(5)});
  const auto seen = [&](std::uint32_t vertex, float value) {
    log.add(RecordedLightSample{.vertex = vertex,
                                .position = {0, 0, 5},
                                .kind = VertexKind::sensor,
                                .event = Event::smooth_reflect,
                                .contribution = Rgb(2 * value),
                                .joint_contribution = Rgb(value)});
  };
  seen(1, 0.1f);
  seen(2, 0.2f);
  return log;
}

TEST_CASE("samples: paths from lights are read as if they came from the sensor") {
  CHECK(samples_of(path_from_light()).empty());
  SampleRule rule = kRule;
  rule.light_paths = true;
  const std::vector<Sample> samples = samples_of(path_from_light(), rule);
  REQUIRE(samples.size() == 3);
  CHECK(samples[0].weight == doctest::Approx(10 * 0.5 * 0.2));
  CHECK(samples[0].triplet.mode ==
        Mode{VertexKind::surface, Event::smooth_reflect, VertexKind::environment});
  CHECK(samples[0].triplet.vertices[0] == Point3{2, 0, 0});
  CHECK(samples[0].triplet.vertices[2] == Point3{1, 100, 0});
  CHECK(samples[1].weight == doctest::Approx(10 * 0.1));
  CHECK(samples[1].triplet.mode ==
        Mode{VertexKind::sensor, Event::smooth_reflect, VertexKind::environment});
  CHECK(samples[2].weight == doctest::Approx(5 * 0.2));
  CHECK(samples[2].triplet.vertices[2] == Point3{1, 0, 0});
}

TEST_CASE("samples: lights that no step can meet are of a kind of their own; nothing of NaN") {
  PathLog log;
  log.begin_path({}, Transport::radiance);
  log.add(RecordedVertex{.kind = VertexKind::sensor, .throughput = Rgb(1)});
  log.add(RecordedVertex{.position = {0, 0, 1}, .parent = 0, .throughput = Rgb(1)});
  RecordedLightSample sun{.vertex = 1,
                          .kind = VertexKind::environment,
                          .event = Event::smooth_reflect,
                          .discrete = true,
                          .direction = {0, 1, 0},
                          .contribution = Rgb(3)};
  log.add(sun);
  sun.contribution = Rgb(std::nanf(""));
  log.add(sun);
  const std::vector<Sample> samples = samples_of(log);
  REQUIRE(samples.size() == 1);
  CHECK(samples[0].triplet.mode.after == VertexKind::light);
  CHECK(samples[0].triplet.vertices[2] == Point3{0, 100, 1});
  // The mixture of first vertices uses this sample, the mixtures of next vertices do not.
  const VertexTripletsLearner learner({.cells = 1});
  const auto state = learner.begin({.region = {{-1, -1, -1}, {1, 1, 1}}});
  state->absorb(log);
  const auto model =
      std::dynamic_pointer_cast<const VertexTripletsModel>(state->update({0, 0}).model);
  REQUIRE(model);
  CHECK(model->camera().size() == 1);
  CHECK(model->component_count() == 0);
}

// --- learning ------------------------------------------------------------------------------------

/// Adds paths over a mirror-like floor under a lens. Light reaches a point of the floor from the
/// mirrored direction of the lens.
void add_mirror_paths(PathLog& log, int count, std::uint64_t seed, float light = 1) {
  RandomStream random(seed);
  for (int i = 0; i < count; ++i) {
    const Vec2 u = random.next_2d(), v = random.next_2d();
    const Point3 lens{v.x, v.y, 1}, floor{2 * u.x - 0.5f, 2 * u.y - 0.5f, 0};
    const Vec3 in = floor - lens;
    const Point3 ceiling = floor + Vec3{in.x, in.y, 1} + 0.02f * Vec3{random.next_1d(), 0, 0};
    log.begin_path({}, Transport::radiance);
    log.add(RecordedVertex{.position = lens, .kind = VertexKind::sensor, .throughput = Rgb(1)});
    log.add(RecordedVertex{.position = floor,
                           .event = Event::smooth_reflect,
                           .parent = 0,
                           .throughput = Rgb(1),
                           .local_weight = Rgb(1),
                           .direction = normalize(ceiling - floor)});
    log.add(RecordedVertex{
        .position = ceiling, .parent = 1, .emission = Rgb(light), .joint_emission = Rgb(light)});
  }
}

PathLog mirror_paths(int count, std::uint64_t seed) {
  PathLog log;
  add_mirror_paths(log, count, seed);
  return log;
}

LearningContext context() {
  Bounds3 region;
  region.add(Point3{-1.5f, -1.5f, 0});
  region.add(Point3{2.5f, 2.5f, 1});
  return {.region = region, .seed = 7};
}

std::shared_ptr<const VertexTripletsModel> learned(const VertexTripletsSettings& settings,
                                                   std::uint32_t updates = 3) {
  const auto state = VertexTripletsLearner(settings).begin(context());
  std::shared_ptr<const GuidingModel> model;
  for (std::uint32_t i = 0; i < updates; ++i) {
    state->absorb(mirror_paths(2000 << i, 20 + i));
    model = state->update({i, updates - 1 - i}).model;
  }
  return std::dynamic_pointer_cast<const VertexTripletsModel>(model);
}

/// Returns the mean distance between the point on the ceiling from which light comes and the means
/// that the model predicts.
double mirror_error(const VertexTripletsModel& model) {
  class Flat final : public PhaseFunction {
   public:
    float evaluate(Vec3, Vec3) const override { return 1; }
    Vec3 sample(Vec3 wo, Vec2) const override { return wo; }
    float mean_cosine() const override { return 0; }
  } flat;
  RandomStream random(99);
  double sum = 0;
  int answers = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec2 u = random.next_2d(), v = random.next_2d();
    const Point3 lens{v.x, v.y, 1}, floor{2 * u.x - 0.5f, 2 * u.y - 0.5f, 0};
    const GuidingVertex previous{.position = lens, .kind = VertexKind::sensor};
    const GuidingVertex current{.position = floor};
    const Vec3 back = normalize(lens - floor);
    const LocalScattering scattering(flat, Rgb(1), back, Transport::radiance);
    const GuidingQuery query{.previous = &previous,
                             .current = current,
                             .towards_previous = back,
                             .scattering = &scattering,
                             .region = model.place(current).region};
    Arena arena;
    const Vec3 in = floor - lens;
    for (const testing::NextVertex& next :
         testing::vertices_of(model.next_vertices(query, mask_of(Event::smooth_reflect), arena))) {
      const Point3 ceiling = floor + Vec3{in.x, in.y, 1};
      sum += next.gaussian.weight * length(next.gaussian.mean - ceiling);
      answers += 1;
    }
  }
  return answers > 0 ? sum / 300 : 1e9;
}

TEST_CASE("learning: triplets know a mirror's direction, pairs its mean") {
  VertexTripletsSettings settings{.cells = 16, .reservoir = 1024};
  const auto triplets = learned(settings);
  REQUIRE(triplets);
  CHECK(mirror_error(*triplets) < 0.03);
  CHECK(triplets->camera().size() > 0);
  CHECK(triplets->info().regions >= 8);
  settings.vertices = Prefix::pair;
  const auto pairs = learned(settings);
  CHECK(mirror_error(*pairs) > 0.2);
}

TEST_CASE("learning: cells divide by effective numbers, which a few heavy samples do not raise") {
  const auto cells = [](double least_effective, float heavy) {
    const auto state =
        VertexTripletsLearner({.cells = 64, .least_effective = least_effective}).begin(context());
    PathLog log;
    add_mirror_paths(log, 4000, 3);
    add_mirror_paths(log, 40, 5, heavy);
    state->absorb(log);
    state->update({0, 1});
    state->absorb(mirror_paths(1, 4));
    return state->update({1, 0}).model->info().regions - 1;
  };
  CHECK(cells(0, 1e6f) > 1);
  CHECK(cells(200, 1) > 1);
  CHECK(cells(200, 1e6f) == 1);  // 40 heavy samples have all the weight
}

TEST_CASE("learning: the camera is a region of its own, which comes from itself") {
  const auto state = VertexTripletsLearner({.cells = 16}).begin(context());
  std::uint32_t before = 0;
  for (std::uint32_t i = 0; i < 3; ++i) {
    state->absorb(mirror_paths(2000, i));
    const Learned learned = state->update({i, 2 - i});
    const std::uint32_t regions = learned.model->info().regions;
    REQUIRE(learned.region_origins.size() == regions);
    CHECK(learned.region_origins.back() == before);
    const GuidingVertex lens{.position = {0.5f, 0.5f, 1}, .kind = VertexKind::sensor};
    CHECK(learned.model->place(lens).region == regions - 1);
    CHECK(learned.model->place({.position = {0.5f, 0.5f, 0}}).region < regions - 1);
    before = regions - 1;
  }
}

TEST_CASE("learning: knows nothing of nothing") {
  const auto state = VertexTripletsLearner({}).begin(context());
  CHECK(state->update({0, 1}).model == nullptr);
  state->absorb(PathLog{});
  CHECK(state->update({1, 1}).model == nullptr);
  const auto later = VertexTripletsLearner({}).begin(context());
  later->absorb(mirror_paths(1, 1));
  CHECK(later->update({0, 1}).model != nullptr);
}

VertexTripletsModel loaded_model(const std::string& bytes) {
  std::istringstream in(bytes);
  VertexTripletsModel model;
  load(in, model);
  return model;
}

TEST_CASE("learning: the same for 1, 2, 3 and 7 threads, all variants") {
  for (const auto& [vertices, light_paths] :
       {std::pair{Prefix::pair, false}, {Prefix::triplet, false}, {Prefix::triplet, true}}) {
    std::string first;
    for (const int threads : {1, 2, 3, 7}) {
      const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
      const auto model = learned(
          {.vertices = vertices, .light_paths = light_paths, .cells = 16, .reservoir = 256});
      if (first.empty()) first = saved(*model);
      CHECK(saved(*model) == first);
    }
  }
}

TEST_CASE("models: loaded they are the same, both ways; damage is noticed") {
  for (const auto vertices : {Prefix::pair, Prefix::triplet}) {
    const auto model = learned({.vertices = vertices,
                                .light_paths = vertices == Prefix::triplet,
                                .cells = 8,
                                .reservoir = 128});
    const std::string bytes = saved(*model);
    const VertexTripletsModel loaded = loaded_model(bytes);
    CHECK(saved(loaded) == bytes);
    CHECK(loaded.info().bytes == model->info().bytes);
    CHECK(loaded.kind().both_ways == (vertices == Prefix::triplet));
    for (std::size_t length : {std::size_t{5}, bytes.size() / 2, bytes.size() - 1}) {
      CHECK_THROWS_AS(loaded_model(bytes.substr(0, length)), InputError);
    }
  }
}

TEST_CASE("learning: saved and loaded amid an iteration it goes on as before") {
  const VertexTripletsLearner learner({.cells = 16, .reservoir = 64});
  const auto state = learner.begin(context());
  const auto resumed = [&](const std::string& text) {
    std::istringstream in(text);
    auto result = learner.begin(context());
    load(in, *result);
    return result;
  };
  for (std::uint32_t i = 0; i < 3; ++i) {
    state->absorb(mirror_paths(500, i));
    if (i < 2) state->update({i, 1});
  }
  const std::string bytes = saved(*state);
  const auto again = resumed(bytes);
  CHECK(saved(*again) == bytes);
  for (const auto* s : {&state, &again}) (*s)->absorb(mirror_paths(700, 9));
  CHECK(saved(*state->update({2, 0}).model) == saved(*again->update({2, 0}).model));
  for (const std::size_t length : {std::size_t{3}, bytes.size() / 3, bytes.size() - 1}) {
    CHECK_THROWS_AS(resumed(bytes.substr(0, length)), InputError);
  }
  // Changed bytes are noticed or harmless. They must not cause a crash or break update().
  RandomStream random(1);
  int noticed = 0;
  for (int i = 0; i < 300; ++i) {
    std::string changed = bytes;
    changed[random() % bytes.size()] = static_cast<char>(random());
    try {
      resumed(changed)->update({3, 0});
    } catch (const InputError&) {
      ++noticed;
    }
  }
  CHECK(noticed > 0);
}

TEST_CASE("learning: what is absorbed in pieces is what is absorbed at once") {
  const VertexTripletsLearner learner({.cells = 16, .reservoir = 64});
  const auto whole = learner.begin(context()), pieces = learner.begin(context());
  PathLog log = mirror_paths(500, 1);
  add_mirror_paths(log, 400, 2);
  whole->absorb(log);
  pieces->absorb(mirror_paths(500, 1));
  pieces->absorb(mirror_paths(400, 2));
  CHECK(saved(*whole) == saved(*pieces));
  CHECK(saved(*whole->update({0, 1}).model) == saved(*pieces->update({0, 1}).model));
}

TEST_CASE("models: changed bytes are noticed or harmless") {
  const auto model = learned({.light_paths = true, .cells = 8, .reservoir = 64}, 2);
  const std::string bytes = saved(*model);
  RandomStream random(2);
  int noticed = 0;
  for (int i = 0; i < 300; ++i) {
    std::string changed = bytes;
    changed[random() % bytes.size()] = static_cast<char>(random());
    try {
      mirror_error(loaded_model(changed));
    } catch (const InputError&) {
      ++noticed;
    }
  }
  CHECK(noticed > 0);
}

TEST_CASE("models: densities for pictures are those of the learned samples") {
  const std::shared_ptr<const GuidingModel> model = learned({.cells = 16, .reservoir = 512});
  CHECK(model->density({0.5f, 0.5f, 0}) > 0);
  CHECK(model->density({0.5f, 0.5f, 0}) > 100 * model->density({0.5f, 0.5f, 0.9f}));
  // Light comes roughly from above.
  const Vec3 up{0, 0, 1}, down{0, 0, -1};
  CHECK(model->density({0.5f, 0.5f, 0}, &up) > model->density({0.5f, 0.5f, 0}, &down));
}

TEST_CASE("learner: pairs cannot learn from paths from lights") {
  CHECK_THROWS_AS(VertexTripletsLearner({.vertices = Prefix::pair, .light_paths = true}),
                  InputError);
  CHECK(!VertexTripletsLearner({}).traits().records.light_paths);
  CHECK(VertexTripletsLearner({.light_paths = true}).traits().records.light_paths);
}

}  // namespace
}  // namespace pharos::vertex_triplets
