// Furnace tests of every kind of guide. With any guide, the integrator must give the exact answer.

#include "furnace.h"

#include <cmath>

namespace pharos::testing {
namespace {

std::string pair(const std::string& learner, const std::string& guider,
                 const std::string& more = "") {
  return fmt::format("{{ learner: {}, guider: {}, {}training: {{ iterations: 3 }} }}", learner,
                     guider, more);
}

double diffuse_t(const std::string& guiding, const std::string& sampler = "independent") {
  return furnace_t(path_config(kDiffuseScene, 4, guiding, 32, sampler), kDiffuseFurnace);
}

double fog_t(const std::string& guiding) {
  return furnace_t(path_config(kGlassInFogScene, 100, guiding, 32), kGlassInFogFurnace);
}

TEST_CASE("furnace: unguided") {
  CHECK(std::abs(diffuse_t("")) < kLimit);
  CHECK(std::abs(fog_t("")) < kLimit);
}

/// Returns the same config with bidirectional path tracing.
std::string from_both_ends(std::string config) {
  const std::string path = "type: path\n";
  return config.replace(config.find(path), path.size(), "type: bidirectional\n");
}

TEST_CASE("furnace: paths from both ends, unguided and guided in both directions") {
  for (const std::string& guiding :
       {std::string(), pair("stub_direction", "stub_direction"),
        pair("stub_vertices", "stub_vertices"), pair("stub_mixture", "stub_exact"),
        pair("stub_camera", "stub_camera")}) {
    CAPTURE(guiding);
    CHECK(std::abs(furnace_t(from_both_ends(path_config(kDiffuseScene, 4, guiding, 32)),
                             kDiffuseFurnace)) < kLimit);
    CHECK(std::abs(furnace_t(from_both_ends(path_config(kGlassInFogScene, 100, guiding, 32)),
                             kGlassInFogFurnace)) < kLimit);
  }
}

TEST_CASE("furnace: from both ends, a density off by 3 % is seen") {
  const std::string guider = "{ type: stub_direction, pdf_scale: 1.03 }";
  const std::string config = path_config(kDiffuseScene, 4, pair("stub_direction", guider), 16);
  CHECK(furnace_t(from_both_ends(config), kDiffuseFurnace) < -kLimit);
}

TEST_CASE("furnace (a): a direction-only method") {
  CHECK(std::abs(diffuse_t(pair("stub_direction", "stub_direction"))) < kLimit);
  CHECK(std::abs(fog_t(pair("stub_direction", "stub_direction"))) < kLimit);
}

TEST_CASE("furnace: a deliberately bad guide is noisy, not wrong") {
  const std::string guider = "{ type: stub_direction, adversarial: true }";
  CHECK(std::abs(diffuse_t(pair("stub_direction", guider))) < kLimit);
}

TEST_CASE("furnace: a density off by 3 % is seen") {
  const std::string guider = "{ type: stub_direction, pdf_scale: 1.03 }";
  const std::string config = path_config(kDiffuseScene, 4, pair("stub_direction", guider), 16);
  CHECK(furnace_t(config, kDiffuseFurnace) < -kLimit);
}

TEST_CASE("furnace (b): a method that splats along segments") {
  CHECK(std::abs(diffuse_t(pair("stub_segments", "stub_segments"))) < kLimit);
}

TEST_CASE("furnace (c): whole vertices, distances, discrete events, declined by prefix") {
  CHECK(std::abs(diffuse_t(pair("stub_vertices", "stub_vertices"))) < kLimit);
  CHECK(std::abs(fog_t(pair("stub_vertices", "stub_vertices"))) < kLimit);
}

TEST_CASE("furnace (d): a guided first vertex, through the splat layer") {
  CHECK(std::abs(diffuse_t(pair("stub_camera", "stub_camera"))) < kLimit);
  CHECK(std::abs(fog_t(pair("stub_camera", "stub_camera"))) < kLimit);
}

TEST_CASE("furnace (d): wide filters and combined images keep the splat layer exact") {
  const std::string guiding =
      "{ learner: stub_camera, guider: stub_camera, "
      "training: { iterations: 2, images: combine } }";
  std::string config = path_config(kDiffuseScene, 4, guiding, 32);
  const std::string box = "filter: box";
  config.replace(config.find(box), box.size(), "filter: { type: gaussian, radius: 2 }");
  CHECK(std::abs(furnace_t(config, kDiffuseFurnace)) < kLimit);
  const RenderResult result = render(config);
  CHECK(result.image.pixel(16, 16)[result.image.channel_index("depth.Z")] > 0);
}

TEST_CASE("furnace (d): a window of the film") {
  const std::string film = "filter: box";
  std::string scene = kDiffuseScene;
  scene.replace(scene.find(film), film.size(),
                film + ", crop: { x: 4, y: 9, width: 24, height: 15 }");
  const std::string config = path_config(scene, 4, pair("stub_camera", "stub_camera"), 128);
  CHECK(std::abs(furnace_t(config, kDiffuseFurnace)) < kLimit);
}

TEST_CASE("furnace (d): a camera density off by 3 % is seen") {
  const std::string guider = "{ type: stub_camera, pdf_scale: 1.03 }";
  const std::string config = path_config(kDiffuseScene, 1, pair("stub_camera", guider), 128);
  CHECK(std::abs(furnace_t(config, 1, 24)) > kLimit);
}

TEST_CASE("furnace (e): shares learned for regions that are refined") {
  const std::string guiding =
      pair("{ type: stub_direction, refine: true }", "stub_direction", "mixing: stub_learned, ");
  CHECK(std::abs(diffuse_t(guiding)) < kLimit);
}

TEST_CASE("furnace: the policy that learns by descent") {
  for (const std::string objective : {"kl", "variance"}) {
    const std::string mixing = "mixing: { type: learned, objective: " + objective + " }, ";
    const std::string guiding =
        pair("{ type: stub_direction, refine: true }", "stub_direction", mixing);
    CHECK(std::abs(diffuse_t(guiding)) < kLimit);
    CHECK(std::abs(fog_t(pair("stub_vertices", "stub_vertices", mixing))) < kLimit);
  }
  CHECK(std::abs(diffuse_t(pair("stub_camera", "stub_camera", "mixing: learned, "))) < kLimit);
}

TEST_CASE("furnace: the policy that learns the shares of all methods") {
  const std::string mixing = "mixing: { type: simplex, cell_steps: 256, worth: 1 }, ";
  CHECK(std::abs(diffuse_t(
            pair("{ type: stub_direction, refine: true }", "stub_direction", mixing))) < kLimit);
  CHECK(std::abs(fog_t(pair("stub_vertices", "stub_vertices", mixing))) < kLimit);
  CHECK(std::abs(diffuse_t(pair("stub_camera", "stub_camera", mixing))) < kLimit);
  const std::string three =
      "{ methods: [ { learner: stub_direction, guider: stub_direction, weight: 2 }, "
      "{ learner: stub_mixture, guider: stub_exact }, "
      "{ learner: stub_vertices, guider: stub_vertices } ], " +
      mixing + "training: { iterations: 3, schedule: geometric, images: combine } }";
  CHECK(std::abs(diffuse_t(three)) < kLimit);
  CHECK(std::abs(fog_t(three)) < kLimit);
}

TEST_CASE("furnace (f): a sampler that probes the light-position integrand") {
  CHECK(std::abs(diffuse_t("", "stub_probing")) < kLimit);
}

TEST_CASE("furnace (g): one mixture model, two guiders of another module") {
  CHECK(std::abs(diffuse_t(pair("stub_mixture", "stub_exact"))) < kLimit);
  CHECK(std::abs(diffuse_t(pair("stub_mixture", "stub_projected"))) < kLimit);
}

TEST_CASE("furnace (h): a method that remembers its path") {
  const std::string guiding = pair("uniform", "stub_memory");
  CHECK(std::abs(diffuse_t(guiding)) < kLimit);
  CHECK(std::abs(furnace_t(from_both_ends(path_config(kDiffuseScene, 4, guiding, 32)),
                           kDiffuseFurnace)) < kLimit);
}

TEST_CASE("furnace: two methods that share one model") {
  const std::string guiding =
      "{ methods: [ { learner: uniform, guider: uniform }, { guider: stub_memory, weight: 3 } ], "
      "training: { iterations: 3 } }";
  CHECK(std::abs(diffuse_t(guiding)) < kLimit);
}

TEST_CASE("furnace: several methods side by side") {
  const std::string guiding =
      "{ methods: [ { learner: stub_direction, guider: stub_direction, weight: 2 }, "
      "{ learner: stub_mixture, guider: stub_exact }, "
      "{ learner: stub_vertices, guider: stub_vertices } ], mixing: stub_learned, "
      "training: { iterations: 3, schedule: geometric, images: combine } }";
  CHECK(std::abs(diffuse_t(guiding)) < kLimit);
  CHECK(std::abs(fog_t(guiding)) < kLimit);
}

TEST_CASE("a learner's model must be what the guider samples") {
  CHECK_THROWS_WITH_AS(
      config_from(path_config(kDiffuseScene, 4, pair("stub_mixture", "stub_direction"), 1)),
      doctest::Contains("the learner 'stub_mixture' learns a 'stub_mixture' model, but the "
                        "guider 'stub_direction' samples a 'stub_direction' model"),
      InputError);
}

}  // namespace
}  // namespace pharos::testing
