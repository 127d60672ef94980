#include "bench_scenes.h"

#include <fmt/format.h>

#include "meshes.h"

namespace pharos::bench {
namespace {

constexpr const char* kMesh = "field.ply";

}  // namespace

std::string scene_entry(const std::string& name) {
  return fmt::format("scene: {}/{}/scene.yaml\n", PHAROS_SCENES, name);
}

std::string learning_config(const std::string& scene, const std::string& learner,
                            const std::string& guider, double seconds) {
  return fmt::format(R"({}
film: {{ width: 240, height: 160, filter: box }}
budget: {{ seconds: {} }}
sampler: sobol
integrator:
  type: path
  max_depth: 12
  guiding: {{ learner: {}, guider: {}, training: {{ schedule: geometric, images: discard }} }}
)",
                     scene_entry(scene), seconds, learner, guider);
}

SphereField::SphereField(int spheres, int rings)
    : triangles_(testing::write_sphere_field(folder_ / kMesh, spheres, rings)) {}

std::string SphereField::entry() const {
  return fmt::format(R"(
scene:
  shapes:
    - {{ type: mesh, file: {}, material: {{ type: diffuse, reflectance: 0.7 }} }}
    - {{ type: quad, to_world: [ {{ rotate: {{ axis: [1, 0, 0], degrees: 90 }} }}, {{ translate: [0, 2, 0] }} ], emitter: {{ type: area, radiance: 5 }} }}
  emitters: [ {{ type: constant, radiance: 0.3 }} ]
  sensor: {{ type: perspective, fov: 40, to_world: {{ look_at: {{ origin: [0, 0, -4], target: [0, 0, 0], up: [0, 1, 0] }} }} }}
)",
                     (folder_ / kMesh).string());
}

}  // namespace pharos::bench
