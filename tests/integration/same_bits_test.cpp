// The same config and seed give the same bits for any number of threads, including learned models.

#include <filesystem>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <pharos/tests/fixtures.h>

#include "meshes.h"
#include "renders.h"

namespace pharos::testing {
namespace {

void check_same_bits(const std::string& config) {
  const std::string one = bits_of(render(config, 1));
  for (const int threads : {1, 2, 3, 7}) {
    const bool same = bits_of(render(config, threads)) == one;
    CHECK_MESSAGE(same, threads << " threads");
  }
}

std::string cornell(const std::string& rest) {
  return fmt::format(
      "scene: {}/cornell-box/scene.yaml\nbudget: {{ spp: 16 }}\n"
      "film: {{ width: 80, height: 64, filter: gaussian }}\n{}",
      PHAROS_SCENES, rest);
}

TEST_CASE("same bits: cornell-box, both samplers") {
  check_same_bits(cornell("sampler: sobol\n"));
  check_same_bits(cornell("sampler: independent\n"));
}

TEST_CASE("same bits: what light paths splat") {
  for (const char* integrator : {"light", "bidirectional"}) {
    check_same_bits(cornell(fmt::format("sampler: sobol\nintegrator: {}\n", integrator)));
    check_same_bits(fmt::format(
        "scene: {}/fog-box/scene.yaml\nbudget: {{ spp: 8 }}\nfilm: {{ width: 60, height: 48 }}\n"
        "integrator: {}\n",
        PHAROS_SCENES, integrator));
  }
  check_same_bits(
      cornell("integrator: { type: bidirectional, guiding: { learner: uniform, guider: uniform, "
              "training: { iterations: 2 } } }\n"));
}

TEST_CASE("same bits: paths that split, unguided and guided") {
  constexpr const char* kSplit = "termination: { type: stub_factor, factor: 1.6, last: 4 }";
  for (const char* sampler : {"sobol", "independent"}) {
    check_same_bits(
        cornell(fmt::format("sampler: {}\nintegrator: {{ type: path, {} }}\n", sampler, kSplit)));
  }
  check_same_bits(cornell(
      fmt::format("integrator: {{ type: path, {}, guiding: {{ learner: stub_direction, guider: "
                  "stub_direction, training: {{ iterations: 2 }} }} }}\n",
                  kSplit)));
}

TEST_CASE("same bits: paths that split as was learned, with and without guides") {
  for (const char* termination : {"adjoint", "efficiency"}) {
    check_same_bits(cornell(fmt::format(
        "sampler: sobol\nintegrator: {{ type: path, termination: {}, training: {{ iterations: 3 }} "
        "}}\n",
        termination)));
    check_same_bits(cornell(
        fmt::format("integrator: {{ type: path, termination: {}, guiding: {{ learner: "
                    "stub_direction, guider: stub_direction, training: {{ iterations: 3 }} }} }}\n",
                    termination)));
  }
}

TEST_CASE("same bits: guided, with the learned model and either learned mixing") {
  for (const char* mixing : {"stub_learned", "learned"}) {
    check_same_bits(cornell(fmt::format(
        "sampler: sobol\nintegrator: {{ type: path, guiding: {{ learner: {{ type: stub_direction, "
        "refine: true }}, guider: stub_direction, mixing: {}, training: {{ iterations: 3, images: "
        "combine }} }} }}\n",
        mixing)));
  }
}

TEST_CASE("same bits: spatial Gaussians in a tree or as one mixture, with the learned model") {
  for (const char* spatial : {"kdtree, cell_samples: 4096", "single"}) {
    check_same_bits(cornell(fmt::format(
        "sampler: sobol\nintegrator: {{ type: path, guiding: {{ learner: {{ type: "
        "spatial_gaussians, spatial: {} }}, guider: p0, mixing: learned, training: {{ schedule: "
        "geometric }} }} }}\n",
        spatial)));
  }
}

TEST_CASE("same bits: parallax-aware mixtures in a tree or as one, with the learned model") {
  for (const char* settings :
       {"{ type: parallax_aware_mixtures, cell_samples: 4096 }, guider: parallax_aware_mixtures",
        "{ type: parallax_aware_mixtures, spatial: single }, guider: { type: "
        "parallax_aware_mixtures, product: bsdf }"}) {
    check_same_bits(cornell(fmt::format(
        "sampler: sobol\nintegrator: {{ type: path, guiding: {{ learner: {}, mixing: learned, "
        "training: {{ iterations: 3 }} }} }}\n",
        settings)));
  }
}

TEST_CASE("same bits: vertex pairs and triplets, with paths from lights and in fog") {
  const std::string training =
      "guider: vertex_triplets, training: { schedule: geometric, images: combine }";
  check_same_bits(cornell(fmt::format(
      "sampler: sobol\nintegrator: {{ type: path, guiding: {{ learner: {{ type: vertex_triplets, "
      "vertices: pairs }}, {} }} }}\n",
      training)));
  for (const char* light_paths : {"always", "training"}) {
    check_same_bits(fmt::format(
        "scene: {}/fog-box/scene.yaml\nbudget: {{ spp: 16 }}\nfilm: {{ width: 60, height: 48 }}\n"
        "integrator: {{ type: bidirectional, light_paths: {}, guiding: {{ learner: {{ type: "
        "vertex_triplets, light_paths: true }}, {} }} }}\n",
        PHAROS_SCENES, light_paths, training));
  }
}

TEST_CASE("same bits: practical path guiding, with the SD-tree") {
  for (const char* target : {"radiance", "relative"}) {
    check_same_bits(
        cornell(fmt::format("sampler: sobol\nintegrator: {{ type: path, guiding: {{ learner: {{ "
                            "type: practical_path_guiding, target: "
                            "{}, spatial_threshold: 200 }}, guider: practical_path_guiding, "
                            "mixing: learned, training: {{ schedule: "
                            "geometric, images: combine }} }} }}\n",
                            target)));
  }
}

TEST_CASE("same bits: focal guiding, with the learned model") {
  check_same_bits(
      cornell("sampler: sobol\nintegrator: { type: path, guiding: { learner: { type: focal, "
              "local_cells: 2 }, guider: focal, training: { iterations: 4 } } }\n"));
}

TEST_CASE("same bits: a mixture of methods on trial, of which some are left out") {
  for (const double least_gain : {0.001, 10.0}) {
    check_same_bits(cornell(fmt::format(R"(
sampler: sobol
integrator:
  type: path
  guiding:
    methods:
      - {{ learner: parallax_aware_mixtures, guider: parallax_aware_mixtures }}
      - {{ learner: practical_path_guiding, guider: practical_path_guiding }}
      - {{ learner: {{ type: focal, burn_in: 1, catch_up: 8 }}, guider: focal }}
    mixing: simplex
    training: {{ schedule: geometric, images: combine, tolerance: 0.01, least_gain: {},
                 most_noise: 0.5, least_part: 0.01, trial: 0.1 }}
)",
                                        least_gain)));
  }
}

TEST_CASE("same bits: a scene of 300,000 triangles") {
  const test::TemporaryFolder folder;
  const std::filesystem::path mesh = folder / "field.ply";
  const std::size_t triangles = write_sphere_field(mesh, 220, 19);
  CHECK(triangles >= 300'000);
  check_same_bits(fmt::format(R"(
scene:
  shapes: [ {{ type: mesh, file: {}, material: {{ type: diffuse, reflectance: 0.7 }} }} ]
  emitters: [ {{ type: constant, radiance: 1 }} ]
  sensor: {{ type: perspective, fov: 45, to_world: {{ look_at: {{ origin: [0, 0, -4], target: [0, 0, 0], up: [0, 1, 0] }} }} }}
film: {{ width: 64, height: 64 }}
budget: {{ spp: 8 }}
)",
                              mesh.string()));
}

}  // namespace
}  // namespace pharos::testing
