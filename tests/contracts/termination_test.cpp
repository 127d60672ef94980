// Furnace tests of roulette and splitting. With any factor, the integrator must give the exact
// answer.

#include <cmath>

#include <pharos/config/module_loader.h>

#include "furnace.h"
#include "guide_pairs.h"

namespace pharos::testing {
namespace {

/// Walls and a ball that absorb a part of the light and emit as much, a glass ball, and a medium
/// that only scatters. Every pixel shows 1. Paths of 24 segments miss about 1e-5.
constexpr double kAbsorbingFurnace = 1;
const std::string kAbsorbingScene = R"(
scene:
  media:
    fog: { type: stub_gray, scattering: 0.7 }
  shapes:
    - { type: sphere, radius: 1, flip_normals: true, material: { type: diffuse, reflectance: 0.2 }, emitter: { type: area, radiance: 0.8 } }
    - { type: sphere, center: [-0.3, 0.3, 0.3], radius: 0.2, material: { type: diffuse, reflectance: 0.5 }, emitter: { type: area, radiance: 0.5 } }
    - { type: sphere, center: [0.2, -0.1, 0.4], radius: 0.35, material: { type: dielectric, ior: 1.5 }, exterior: fog }
  sensor: { type: perspective, fov: 60, to_world: { look_at: { origin: [-0.3, 0.1, -0.6], target: [0, 0, 0.5], up: [0, 1, 0] } } }
  medium: fog
film: { width: 32, height: 32, filter: box }
)";

/// A glass ball in front of a black wall that emits 1.
const std::string kGlassScene = R"(
scene:
  shapes:
    - { type: sphere, radius: 1, flip_normals: true, material: { type: diffuse, reflectance: 0 }, emitter: { type: area, radiance: 1 } }
    - { type: sphere, center: [0.2, -0.1, 0.4], radius: 0.35, material: { type: dielectric, ior: 1.5 } }
  sensor: { type: perspective, fov: 60, to_world: { look_at: { origin: [-0.3, 0.1, -0.6], target: [0, 0, 0.5], up: [0, 1, 0] } } }
film: { width: 32, height: 32, filter: box }
)";

/// Returns a scene with a quarter of the pixels.
std::string on_small_film(std::string scene) {
  const std::string film = "width: 32, height: 32";
  return scene.replace(scene.find(film), film.size(), "width: 16, height: 16");
}

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

/// The same with a quarter of the pixels, where that is precise enough.
double small_diffuse_t(const std::string& termination, const std::string& guiding = "",
                       int spp = 32, const std::string& integrator = "path") {
  return furnace_t(
      config_with(on_small_film(kDiffuseScene), 4, termination, guiding, spp, integrator),
      kDiffuseFurnace);
}
double small_fog_t(const std::string& termination, const std::string& guiding = "", int spp = 32) {
  return furnace_t(config_with(on_small_film(kGlassInFogScene), 40, termination, guiding, spp),
                   kGlassInFogFurnace);
}

/// Two factors, of the steps and of the light samples.
std::string stubs(float steps, float lights) {
  return fmt::format("{{ type: stub_factor, factor: {}, lights: {} }}", steps, lights);
}

/// A termination that learns, with settings by which many paths split or end after few samples.
std::string learned(const std::string& name) {
  return fmt::format("{{ type: {}, {}cell_steps: 1000, least_steps: 100 }}", name,
                     name == "adjoint" ? "window: 1.1, " : "");
}

/// Few branches suffice, and each of them is long.
double absorbing_t(const std::string& termination, int spp) {
  return furnace_t(config_with(on_small_film(kAbsorbingScene), 24,
                               termination + "\n  most_branches: 20", "", spp),
                   kAbsorbingFurnace);
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
    CHECK(std::abs(small_diffuse_t(stub(factor))) < kLimit);
  }
  CHECK(std::abs(fog_t(stub(1.3f))) < kLimit);
}

TEST_CASE("termination: splitting at the largest factor is unbiased, at the first vertex too") {
  // A path splits until it has its largest number of branches.
  CHECK(std::abs(small_diffuse_t(stub(20), "", 2)) < kLimit);
  CHECK(std::abs(small_diffuse_t(stub(20, 2), "", 2)) < kLimit);
}

TEST_CASE("termination: light samples split and end unbiasedly, with and without the steps") {
  // Light samples alone find the light of paths that hit no light.
  const std::string only = "\n  mis: light_samples";
  for (const float lights : {0.4f, 2.0f, 2.75f, 20.0f}) {
    CAPTURE(lights);
    const int spp = lights > 1 ? 8 : 32;
    CHECK(std::abs(small_diffuse_t(stubs(1, lights), "", spp)) < kLimit);
    CHECK(std::abs(small_diffuse_t(stubs(1, lights) + only)) < kLimit);
    CHECK(std::abs(small_diffuse_t(stubs(1.5f, lights), "", spp)) < kLimit);
    CHECK(std::abs(small_diffuse_t(stubs(0.6f, lights), "", 64)) < kLimit);
  }
  CHECK(std::abs(small_diffuse_t(stubs(2.5f, 2.5f) + "\n  light_selection: all")) < kLimit);
  CHECK(std::abs(small_fog_t(stubs(1.2f, 1.2f))) < kLimit);
  CHECK(std::abs(small_fog_t(stubs(0.8f, 3))) < kLimit);
  CHECK(std::abs(small_diffuse_t(stubs(0.8f, 2.5f), "", 64, "bidirectional")) < kLimit);
}

TEST_CASE("termination: every kind of guide goes along with splitting and roulette") {
  for (const std::string& guiding :
       {pair("stub_direction", "stub_direction"), pair("stub_segments", "stub_segments"),
        pair("stub_vertices", "stub_vertices"), pair("uniform", "stub_memory")}) {
    CAPTURE(guiding);
    CHECK(std::abs(small_diffuse_t(stub(0.7f), guiding)) < kLimit);
    CHECK(std::abs(small_diffuse_t(stub(1.7f), guiding, 16)) < kLimit);
    CHECK(std::abs(small_fog_t(stub(1.3f), guiding, 64)) < kLimit);
  }
  const std::string camera = pair("stub_camera", "stub_camera");
  CHECK(std::abs(diffuse_t(stub(0.7f), camera)) < kLimit);
  CHECK(std::abs(diffuse_t(stub(1.7f), camera, 16)) < kLimit);
  CHECK(std::abs(fog_t(stub(1.3f), camera)) < kLimit);
}

TEST_CASE("termination: paths from lights and from both ends survive roulette unbiasedly") {
  CHECK(std::abs(furnace_t(config_with(kDiffuseScene, 4, stub(0.6f), "", 128, "light"),
                           kDiffuseFurnace)) < kLimit);
  const std::string throughput = "{ type: throughput, depth: 1 }";
  for (const std::string& termination : {stub(0.6f), stub(3), throughput}) {
    CAPTURE(termination);
    CHECK(std::abs(small_diffuse_t(termination, "", 64, "bidirectional")) < kLimit);
  }
  CHECK(std::abs(furnace_t(config_with(kGlassInFogScene, 40, stub(0.8f), "", 64, "bidirectional"),
                           kGlassInFogFurnace)) < kLimit);
}

TEST_CASE("termination: learned factors are unbiased, with and without guides") {
  for (const char* name : {"adjoint", "efficiency"}) {
    CAPTURE(name);
    const std::string termination = learned(name);
    CHECK(std::abs(small_diffuse_t(termination)) < kLimit);
    CHECK(std::abs(small_fog_t(termination, "", 64)) < kLimit);
    CHECK(std::abs(small_diffuse_t(termination, pair("stub_direction", "stub_direction"))) <
          kLimit);
    CHECK(std::abs(fog_t(termination, pair("stub_camera", "stub_camera"), 48)) < kLimit);
  }
}

TEST_CASE("termination: absorbing walls, glass and fog together, at every factor") {
  for (const std::string& ending : {stub(0.7f), stubs(0.7f, 3), stubs(0.8f, 0.6f)}) {
    CAPTURE(ending);
    CHECK(std::abs(absorbing_t(ending, 160)) < kLimit);
  }
  for (const std::string& splitting : {stub(1.3f), stubs(1, 2.75f)}) {
    CAPTURE(splitting);
    CHECK(std::abs(absorbing_t(splitting, 16)) < kLimit);
  }
  for (const char* name : {"adjoint", "efficiency"}) {
    CAPTURE(name);
    CHECK(std::abs(absorbing_t(learned(name), 64)) < kLimit);
  }
}

TEST_CASE("termination: paths split at the largest factor in fog, with and without lights") {
  // Only the first vertices have this factor, because 20 light samples at all of them would take
  // too long. Depending on the path, the first vertex is in the fog, on glass or on a wall.
  const auto largest = [](int lights) {
    return fmt::format("{{ type: stub_factor, factor: 20, lights: {}, last: 2 }}", lights);
  };
  CHECK(std::abs(absorbing_t(largest(20), 2)) < kLimit);
  CHECK(std::abs(absorbing_t(largest(1), 4)) < kLimit);
}

TEST_CASE("termination: at glass paths survive roulette unbiasedly, and never split") {
  const auto config = [](const std::string& termination) {
    return config_with(kGlassScene, 100, termination);
  };
  const auto vertices = [&](const std::string& termination) {
    return render(config(termination)).counters.vertices;
  };
  CHECK(std::abs(furnace_t(config(stub(0.6f)), 1)) < kLimit);
  const std::uint64_t whole = vertices("none");
  CHECK(static_cast<double>(vertices(stub(0.6f))) < 0.95 * static_cast<double>(whole));
  CHECK(vertices(stub(3)) == whole);
}

/// Returns every pair of a learner and a guider that is installed. They learn little, because there
/// are many renders.
std::vector<GuidePair> installed_pairs() {
  Registry plugins;
  load_modules(plugins, PHAROS_PLUGINS, true);
  std::vector<GuidePair> pairs = guide_pairs(plugins);
  for (GuidePair& each : pairs) {
    // The fits of large mixtures would take most of the time.
    if (each.name.find("vertex_triplets") == 0) {
      each.learner = "{ type: vertex_triplets, cells: 4, components: 8, reservoir: 256 }";
    }
  }
  return pairs;
}

/// Checks a guide with every termination.
void check_with_terminations(const std::string& guiding) {
  for (const std::string& termination :
       {std::string("none"), std::string("{ type: throughput, depth: 1 }"), learned("adjoint"),
        learned("efficiency")}) {
    CAPTURE(termination);
    CHECK(std::abs(furnace_t(config_with(on_small_film(kDiffuseScene), 4, termination, guiding),
                             kDiffuseFurnace)) < kLimit);
  }
}

TEST_CASE("termination: every learner and guider goes along with every termination") {
  const std::vector<GuidePair> pairs = installed_pairs();
  CHECK(pairs.size() >= 8);
  for (const GuidePair& each : pairs) {
    CAPTURE(each.name);
    check_with_terminations(pair(each.learner, each.guider));
  }
}

TEST_CASE("termination: robust guiding goes along with every termination") {
  check_with_terminations("robust");
}

TEST_CASE("termination: a learner finds the same radiance, however paths end and split") {
  // Paths of two segments, so that all learned steps begin at the first vertex.
  const auto radiance = [](const std::string& termination) {
    const std::string guiding =
        "{ learner: uniform, guider: uniform, training: { iterations: 1, share: 0.9 } }";
    const RenderResult result = render(config_with(kDiffuseScene, 2, termination, guiding));
    return result.model->density({}, nullptr);
  };
  const double undivided = radiance("none");
  CHECK(undivided > 0.2);
  for (const std::string& termination : {stub(0.5f), stub(2.5f), stub(4)}) {
    CAPTURE(termination);
    CHECK(radiance(termination) == doctest::Approx(undivided).epsilon(0.02));
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
