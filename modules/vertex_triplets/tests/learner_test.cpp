#include "../learner.h"

#include <sstream>

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <pharos/core/error.h>
#include <pharos/core/random.h>
#include <pharos/tests/fixtures.h>

#include "../model.h"
#include "test_mirror.h"

namespace pharos::vertex_triplets {
namespace {

using namespace testing;
using test::saved;

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
