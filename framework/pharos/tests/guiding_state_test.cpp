// Tests of the learning side of a render. A saved and loaded state continues as if learning had
// never stopped.

#include <string>

#include <doctest/doctest.h>

#include <pharos/guiding/pipeline/guiding_state.h>

#include "tiny_methods.h"

namespace pharos {
namespace {

using test::Methods, test::TinyMixing, test::asked_methods, test::load_from, test::saved,
    test::tiny_settings;

/// Returns a path that finds this much light.
PathLog path_to_light(float light) {
  PathLog log;
  log.begin_path({}, Transport::radiance);
  log.add(RecordedVertex{.kind = VertexKind::sensor});
  log.add(RecordedVertex{.parent = 0, .emission = Rgb(light)});
  return log;
}

/// Returns the share of unguided samples at the lens.
float unguided_share(const GuidingState& state) {
  Arena arena;
  GuidingQuery query{.current = {.kind = VertexKind::sensor}, .bounce = 0};
  return state.frame()->query(query, arena).unguided_share;
}

/// Absorbs a last path of iteration 1 and all of iteration 2.
void finish(GuidingState& state) {
  state.absorb(path_to_light(3));
  state.update({1, 1});
  state.absorb(path_to_light(5));
  state.update({2, 0});
}

}  // namespace

TEST_CASE("guiding state: saved in the middle of an iteration, it ends with the same models") {
  GuidingState state(tiny_settings(), {}), resumed(tiny_settings(), {}),
      forgetful(tiny_settings(), {});
  for (GuidingState* s : {&state, &forgetful}) {
    s->absorb(path_to_light(1));
    s->update({0, 1});
  }
  state.absorb(path_to_light(2));
  const std::string file = saved(state);
  load_from(file, resumed);
  CHECK(saved(resumed) == file);
  for (const std::size_t i : {0u, 1u, 2u}) {
    CHECK(saved(*resumed.model(i)) == saved(*state.model(i)));
  }
  CHECK(unguided_share(resumed) == unguided_share(state));

  for (GuidingState* s : {&state, &resumed, &forgetful}) finish(*s);
  for (const std::size_t i : {0u, 1u, 2u}) {
    CHECK(saved(*resumed.model(i)) == saved(*state.model(i)));
    // Paths that were absorbed before saving make a difference.
    CHECK(saved(*forgetful.model(i)) != saved(*state.model(i)));
  }
  CHECK(resumed.model(0)->density({}) == (0.5 * 1 + 2 + 3) * 0.5 + 5);
  CHECK(saved(resumed) == saved(state));
  CHECK(unguided_share(resumed) == unguided_share(state));
  CHECK(unguided_share(forgetful) != unguided_share(state));
}

TEST_CASE("guiding state: methods that share a model still share it when loaded") {
  GuidingState state(tiny_settings(), {}), resumed(tiny_settings(), {});
  state.absorb(path_to_light(1));
  state.update({0, 1});
  load_from(saved(state), resumed);
  CHECK(resumed.model(0) == resumed.model(1));
  CHECK(resumed.model(0) != resumed.model(2));
}

TEST_CASE("guiding state: saved before anything is known") {
  GuidingState state(tiny_settings(), {}), resumed(tiny_settings(), {});
  state.absorb(path_to_light(1));
  load_from(saved(state), resumed);
  CHECK(resumed.frame() == nullptr);
  CHECK(resumed.model(0) == nullptr);
  for (GuidingState* s : {&state, &resumed}) s->update({0, 0});
  CHECK(saved(resumed) == saved(state));
  CHECK(resumed.model(0)->density({}) == 1);
}

TEST_CASE("guiding state: cut off anywhere, it is refused") {
  GuidingState state(tiny_settings(), {});
  state.absorb(path_to_light(1));
  state.update({0, 1});
  const std::string file = saved(state);
  for (std::size_t size = 0; size < file.size(); ++size) {
    GuidingState resumed(tiny_settings(), {});
    CHECK_THROWS_AS(load_from(file.substr(0, size), resumed), InputError);
  }
}

TEST_CASE(
    "guiding state: methods that are never asked take no part; without any there is no frame") {
  GuidingSettings own = tiny_settings();
  const auto asked_after_training = [&](std::size_t silent) {
    own.mixing = std::make_shared<const TinyMixing>(silent);
    GuidingState state(own, {});
    state.absorb(path_to_light(1));
    state.update({0, 1});
    return asked_methods(state);
  };
  CHECK(asked_after_training(0) == Methods{0, 1, 2});
  CHECK(asked_after_training(2) == Methods{2});
  CHECK(asked_after_training(3).empty());
}

}  // namespace pharos
