// Furnace tests of roulette and splitting. With any factor, the integrator must give the exact
// answer.

#include <cmath>

#include "furnace.h"

namespace pharos::testing {
namespace {

/// A config with a termination.
std::string config_with(const std::string& scene, int depth, const std::string& termination,
                        const std::string& guiding = "", int spp = 32,
                        const std::string& integrator = "path") {
  return scene + fmt::format(
                     "integrator:\n  type: {}\n  max_depth: {}\n  termination: {}\n{}\n"
                     "sampler: independent\nbudget: {{ spp: {} }}\n",
                     integrator, depth, termination, guiding.empty() ? "" : "  guiding: " + guiding,
                     spp);
}

std::string stub(float factor, int first = 1) {
  return fmt::format("{{ type: stub_factor, factor: {}, first: {} }}", factor, first);
}

double diffuse_t(const std::string& termination, const std::string& guiding = "", int spp = 32) {
  return furnace_t(config_with(kDiffuseScene, 4, termination, guiding, spp), kDiffuseFurnace);
}
double fog_t(const std::string& termination, const std::string& guiding = "", int spp = 32) {
  return furnace_t(config_with(kGlassInFogScene, 40, termination, guiding, spp),
                   kGlassInFogFurnace);
}

std::string pair(const std::string& learner, const std::string& guider) {
  return fmt::format("{{ learner: {}, guider: {}, training: {{ iterations: 3 }} }}", learner,
                     guider);
}

TEST_CASE("termination: roulette at every vertex is unbiased") {
  CHECK(std::abs(diffuse_t(stub(0.3f), "", 64)) < kLimit);
  CHECK(std::abs(fog_t(stub(0.7f), "", 64)) < kLimit);
}

TEST_CASE("termination: splitting is unbiased, by whole numbers and by others") {
  for (const float factor : {2.0f, 2.75f}) {
    CHECK(std::abs(diffuse_t(stub(factor))) < kLimit);
  }
  CHECK(std::abs(fog_t(stub(1.3f))) < kLimit);
}

TEST_CASE("termination: splitting at the largest factor is unbiased, at the first vertex too") {
  // A path splits until it has its largest number of branches.
  CHECK(std::abs(diffuse_t(stub(20), "", 8)) < kLimit);
  CHECK(std::abs(diffuse_t(stub(20, 2), "", 8)) < kLimit);
}

TEST_CASE("termination: light samples split and end unbiasedly, with and without the steps") {
  const auto both = [](float steps, float lights) {
    return fmt::format("{{ type: stub_factor, factor: {}, lights: {} }}", steps, lights);
  };
  // Light samples alone find the light of paths that hit no light.
  const std::string only = "\n  mis: light_samples";
  for (const float lights : {0.4f, 2.0f, 2.75f, 20.0f}) {
    CAPTURE(lights);
    CHECK(std::abs(diffuse_t(both(1, lights))) < kLimit);
    CHECK(std::abs(diffuse_t(both(1, lights) + only)) < kLimit);
    CHECK(std::abs(diffuse_t(both(1.5f, lights))) < kLimit);
    CHECK(std::abs(diffuse_t(both(0.6f, lights), "", 64)) < kLimit);
  }
  CHECK(std::abs(diffuse_t(both(2.5f, 2.5f) + "\n  light_selection: all")) < kLimit);
  CHECK(std::abs(fog_t(both(1.2f, 1.2f))) < kLimit);
  CHECK(std::abs(fog_t(both(0.8f, 3))) < kLimit);
  CHECK(std::abs(furnace_t(config_with(kDiffuseScene, 4, both(0.8f, 2.5f), "", 64, "bidirectional"),
                           kDiffuseFurnace)) < kLimit);
}

TEST_CASE("termination: every kind of guide goes along with splitting and roulette") {
  for (const std::string& guiding :
       {pair("stub_direction", "stub_direction"), pair("stub_segments", "stub_segments"),
        pair("stub_vertices", "stub_vertices"), pair("stub_camera", "stub_camera"),
        pair("uniform", "stub_memory")}) {
    CAPTURE(guiding);
    for (const float factor : {0.7f, 1.7f}) {
      CHECK(std::abs(diffuse_t(stub(factor), guiding)) < kLimit);
    }
    CHECK(std::abs(fog_t(stub(1.3f), guiding)) < kLimit);
  }
}

TEST_CASE("termination: paths from lights and from both ends survive roulette unbiasedly") {
  CHECK(std::abs(furnace_t(config_with(kDiffuseScene, 4, stub(0.6f), "", 128, "light"),
                           kDiffuseFurnace)) < kLimit);
  const std::string throughput = "{ type: throughput, depth: 1 }";
  for (const std::string& termination : {stub(0.6f), stub(3), throughput}) {
    CAPTURE(termination);
    CHECK(std::abs(furnace_t(config_with(kDiffuseScene, 4, termination, "", 64, "bidirectional"),
                             kDiffuseFurnace)) < kLimit);
  }
  CHECK(std::abs(furnace_t(config_with(kGlassInFogScene, 40, stub(0.8f), "", 64, "bidirectional"),
                           kGlassInFogFurnace)) < kLimit);
}

TEST_CASE("termination: learned factors are unbiased, with and without guides") {
  for (const char* name : {"adjoint", "efficiency"}) {
    CAPTURE(name);
    // A narrow window, so that many paths split or end.
    const std::string termination =
        fmt::format("{{ type: {}, {}cell_steps: 1000, least_steps: 100 }}", name,
                    std::string(name) == "adjoint" ? "window: 1.1, " : "");
    CHECK(std::abs(diffuse_t(termination)) < kLimit);
    CHECK(std::abs(fog_t(termination)) < kLimit);
    CHECK(std::abs(diffuse_t(termination, pair("stub_direction", "stub_direction"))) < kLimit);
    CHECK(std::abs(fog_t(termination, pair("stub_camera", "stub_camera"))) < kLimit);
  }
}

TEST_CASE("termination: a learner finds the same radiance, however paths end and split") {
  // Paths of two segments, so that all learned steps begin at the first vertex.
  const auto learned = [](const std::string& termination) {
    const std::string guiding =
        "{ learner: uniform, guider: uniform, training: { iterations: 1, share: 0.9 } }";
    const RenderResult result = render(config_with(kDiffuseScene, 2, termination, guiding));
    return result.model->density({}, nullptr);
  };
  const double undivided = learned("none");
  CHECK(undivided > 0.2);
  for (const std::string& termination : {stub(0.5f), stub(2.5f), stub(4)}) {
    CAPTURE(termination);
    CHECK(learned(termination) == doctest::Approx(undivided).epsilon(0.02));
  }
}

TEST_CASE("termination: what learns must be able to teach") {
  for (const char* integrator : {"light", "bidirectional"}) {
    CHECK_THROWS_WITH(config_from(config_with(kDiffuseScene, 4, "adjoint", "", 1, integrator)),
                      doctest::Contains("the termination 'adjoint' learns"));
  }
}

TEST_CASE("termination: `throughput` is the roulette of the integrator's own settings") {
  const auto bits = [](const std::string& settings) {
    return bits_of(render(kGlassInFogScene +
                          "sampler: sobol\nbudget: { spp: 4 }\nintegrator: { "
                          "type: path, max_depth: 40, " +
                          settings + " }\n"));
  };
  const std::string own = bits("roulette: throughput, roulette_depth: 2, roulette_limit: 0.7");
  const bool same = bits("termination: { type: throughput, depth: 2, limit: 0.7 }") == own;
  CHECK(same);
  const bool off = bits("termination: none") == bits("roulette: off");
  CHECK(off);
  const bool differs = bits("termination: none") != own;
  CHECK(differs);
}

}  // namespace
}  // namespace pharos::testing
