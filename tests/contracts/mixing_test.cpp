// Learned mixing follows a guide that refines its regions.

#include <pharos/guiding/pipeline/guiding_state.h>

#include "furnace.h"

namespace pharos::testing {
namespace {

TEST_CASE("regions double and keep what was learned for them") {
  const LoadedConfig loaded = config_from(
      path_config(kDiffuseScene, 4,
                  "{ learner: { type: stub_direction, refine: true }, guider: stub_direction, "
                  "mixing: stub_learned }",
                  8));
  const GuidingSettings& settings = *loaded.config.integrator->guiding();
  GuidingState state(settings, {.region = {{-1, -1, -1}, {1, 1, 1}}, .seed = 1});
  CHECK(state.frame() == nullptr);

  // One guidable vertex whose light came all from unguided sampling: its region's fraction goes to
  // the top, whatever the other regions do.
  PathLog log;
  log.begin_path({}, Transport::radiance);
  log.add(RecordedVertex{.kind = VertexKind::sensor});
  RecordedVertex vertex{.position = {-0.9f, 0, 0}, .parent = 0, .local_weight = Rgb(1)};
  vertex.direction = {0, 0, 1};
  vertex.guidable = true;
  vertex.unguided_fraction = 0.5f;
  vertex.unguided_pdf = 1;
  vertex.guided_pdf = 0.01f;
  log.add(vertex);
  log.add(RecordedVertex{.parent = 1, .emission = Rgb(1)});

  state.absorb(log);
  state.update(0, false);
  CHECK(state.model(0)->region_count() == 1);
  for (std::uint32_t iteration = 1, regions = 2; regions <= 8; ++iteration, regions *= 2) {
    state.update(iteration, false);
    CHECK(state.model(0)->region_count() == regions);
    const GuidingModel& model = *state.model(0);
    REQUIRE(model.region_origins().size() == regions);
    CHECK(model.region_origins().back() == regions / 2 - 1);
  }

  // What the one region learned is now the fraction everywhere.
  const Bsdf& bsdf = *loaded.config.scene.objects[0].bsdf;
  SurfacePoint point;
  point.normal = {0, 0, 1};
  const LocalScattering scattering(point, bsdf, {0, 0, 1}, Transport::radiance);
  for (const float x : {-0.9f, -0.1f, 0.3f, 0.9f}) {
    const GuidingQuery query{.current = {.position = {x, 0, 0}},
                             .towards_previous = {0, 0, 1},
                             .scattering = scattering};
    Arena arena;
    const Guidance guidance = state.frame()->query(query, arena);
    REQUIRE(guidance.distribution != nullptr);
    CHECK(guidance.unguided_fraction == doctest::Approx(0.9f));
  }
}

}  // namespace
}  // namespace pharos::testing
