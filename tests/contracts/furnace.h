#pragma once

#include <string>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "renders.h"

namespace pharos::testing {

/// A closed furnace, in which every surface emits 1 and reflects 0.5. Paths of k segments carry
/// 0.5^(k-1) for any geometry. A render of depth 4 therefore shows 1 + 1/2 + 1/4 + 1/8 everywhere.
inline constexpr double kDiffuseFurnace = 1.875;
inline const std::string kDiffuseScene = R"(
scene:
  materials:
    wall: { type: diffuse, reflectance: 0.5 }
  shapes:
    - { type: sphere, radius: 1, flip_normals: true, material: wall, emitter: { type: area, radiance: 1 } }
    - { type: sphere, center: [0.3, -0.2, 0.4], radius: 0.25, material: wall, emitter: { type: area, radiance: 1 } }
  sensor: { type: perspective, fov: 60, to_world: { look_at: { origin: [-0.3, 0.1, -0.6], target: [0, 0, 0.5], up: [0, 1, 0] } } }
film: { width: 32, height: 32, filter: box }
)";

/// A black wall that emits 1, around a glass ball and a medium that only scatters. Paths gain and
/// lose nothing on the way, so every pixel shows 1.
inline constexpr double kGlassInFogFurnace = 1;
inline const std::string kGlassInFogScene = R"(
scene:
  media:
    fog: { type: stub_gray, scattering: 0.7 }
  shapes:
    - { type: sphere, radius: 1, flip_normals: true, material: { type: diffuse, reflectance: 0 }, emitter: { type: area, radiance: 1 } }
    - { type: sphere, center: [0.2, -0.1, 0.4], radius: 0.35, material: { type: dielectric, ior: 1.5 }, exterior: fog }
  sensor: { type: perspective, fov: 60, to_world: { look_at: { origin: [-0.3, 0.1, -0.6], target: [0, 0, 0.5], up: [0, 1, 0] } } }
  medium: fog
film: { width: 32, height: 32, filter: box }
)";

inline std::string path_config(const std::string& scene, int depth, const std::string& guiding,
                               int spp, const std::string& sampler = "independent") {
  return scene + fmt::format(
                     "integrator:\n  type: path\n  max_depth: {}\n{}\nsampler: {}\n"
                     "budget: {{ spp: {} }}\n",
                     depth, guiding.empty() ? "" : "  guiding: " + guiding, sampler, spp);
}

/// Returns Student's t of the mean over `runs` seeds against the answer of the furnace. Fails the
/// test if the furnace could not detect a bias of 1 %.
inline double furnace_t(const std::string& config, double expected, int runs = 12) {
  const Estimate found = mean_over_seeds(config, runs);
  CHECK(4 * found.standard_error < 0.01 * expected);
  const double t = (found.mean - expected) / std::max(found.standard_error, 1e-6 * expected);
  MESSAGE("mean " << found.mean << " +- " << found.standard_error << ", expected " << expected);
  return t;
}

/// The limit of |t|. With 12 runs, fewer than 1 of 500 tests exceed it by chance.
inline constexpr double kLimit = 4;

}  // namespace pharos::testing
