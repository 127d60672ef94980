// Scenes in the format of pbrt-v4 and as YAML give the same image, to the bit where all parameters
// of one have an equivalent in the other.

#include <string>

#include <doctest/doctest.h>
#include <fmt/core.h>

#include <pharos/tests/fixtures.h>

#include "../support/renders.h"

namespace pharos::testing {
namespace {

/// Renders both files of a folder, each beside the files that it names.
void check_same_image(const test::TemporaryFolder& folder, const std::string& pbrt,
                      const std::string& scene, const std::string& rest) {
  folder.write("scene.pbrt", pbrt);
  folder.write("scene.yaml", scene);
  const auto file = [&](const char* name) {
    return fmt::format("scene: '{}'\n", (folder / name).string());
  };
  const RenderResult imported = render(file("scene.pbrt"));
  const RenderResult written = render(file("scene.yaml") + rest);
  CHECK(image_mean(imported.image) > 0.01);
  CHECK(bits_of(imported) == bits_of(written));
}

constexpr const char* kFilm =
    "Film \"rgb\" \"integer xresolution\" 24 \"integer yresolution\" 16 PixelFilter \"box\"\n"
    "Sampler \"independent\" \"integer pixelsamples\" 4\n";
constexpr const char* kRender =
    "film: { width: 24, height: 16, filter: { type: box } }\n"
    "sampler: independent\nbudget: { spp: 4 }\n"
    "integrator: { type: path, max_depth: 6, termination: throughput }\n";

constexpr const char* kFloor =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
    "z\n"
    "property float u\nproperty float v\nelement face 2\nproperty list uchar int vertex_indices\n"
    "end_header\n-2 0 2 0 0\n2 0 2 1 0\n2 0 -2 1 1\n-2 0 -2 0 1\n3 0 1 2\n3 0 2 3\n";

// The camera stands at (0, 1, 4) and looks along -z; 'Scale -1 1 1' makes the coordinates
// right-handed, as in Pharos. Its field of view of 90 degrees spans the shorter edge.
constexpr const char* kCamera = "Scale -1 1 1 LookAt 0 1 4  0 1 0  0 1 0\n";
constexpr const char* kSensor =
    "sensor: { type: perspective, fov: 112.619865, to_world: { look_at: { origin: [0, 1, 4], "
    "target: "
    "[0, 1, 0], up: [0, 1, 0] } } }\n";

}  // namespace

TEST_CASE("pbrt: glass, metal and a textured floor under a lamp") {
  const test::TemporaryFolder folder;
  folder.write("floor.ply", kFloor);
  check_same_image(
      folder,
      std::string(kCamera) + "Camera \"perspective\"\n" + kFilm +
          "Integrator \"path\"\nWorldBegin\n"
          "Texture \"squares\" \"spectrum\" \"checkerboard\" \"float uscale\" 8 \"float vscale\" 8 "
          "\"rgb tex1\" [ .8 .7 .6 ] \"rgb tex2\" [ .1 .1 .2 ]\n"
          "Material \"diffuse\" \"texture reflectance\" \"squares\"\n"
          "Shape \"trianglemesh\" \"point3 P\" [ -2 0 2  2 0 2  2 0 -2  -2 0 -2 ] \"integer "
          "indices\" "
          "[ 0 1 2 0 2 3 ] \"point2 uv\" [ 0 0 1 0 1 1 0 1 ]\n"
          "AttributeBegin Translate -1 .5 0 Material \"dielectric\" \"float eta\" 1.5 Shape "
          "\"sphere\" \"float radius\" .5 AttributeEnd\n"
          "AttributeBegin Translate 1 .5 0 Material \"conductor\" \"float roughness\" .25 \"bool "
          "remaproughness\" false \"spectrum eta\" \"metal-Au-eta\" \"spectrum k\" \"metal-Au-k\" "
          "Shape \"sphere\" \"float radius\" .5 AttributeEnd\n"
          "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [ 9 8 7 ] \"float scale\" 2 "
          "Translate "
          "0 3 0 Material \"diffuse\" \"rgb reflectance\" [ 0 0 0 ] Shape \"sphere\" \"float "
          "radius\" .25 AttributeEnd\n",
      "materials:\n"
      "  floor: { type: two_sided, bsdf: { type: diffuse, reflectance: { type: mix, first: [0.8, "
      "0.7, "
      "0.6], second: [0.1, 0.1, 0.2], weight: { type: checkerboard, color0: 0, color1: 1, "
      "uv_scale: "
      "[4, 4] } } } }\n"
      "  glass: { type: dielectric, ior: 1.5 }\n"
      "  gold: { type: two_sided, bsdf: { type: rough_conductor, alpha: 0.25, material: Au } }\n"
      "  black: { type: two_sided, bsdf: { type: diffuse, reflectance: 0 } }\n"
      "shapes:\n"
      "  - { type: mesh, file: floor.ply, material: floor }\n"
      "  - { type: sphere, radius: 0.5, material: glass, to_world: [{ scale: [1, 1, -1] }, { "
      "translate: [-1, 0.5, 0] }] }\n"
      "  - { type: sphere, radius: 0.5, material: gold, to_world: [{ scale: [1, 1, -1] }, { "
      "translate: "
      "[1, 0.5, 0] }] }\n"
      "  - { type: sphere, radius: 0.25, material: black, emitter: { type: area, radiance: [9, 8, "
      "7], "
      "scale: 2 }, to_world: [{ scale: [1, 1, -1] }, { translate: [0, 3, 0] }] }\n" +
          std::string(kSensor),
      kRender);
}

TEST_CASE("pbrt: fog, instances and lights without a surface") {
  const test::TemporaryFolder folder;
  folder.write("floor.ply", kFloor);
  check_same_image(
      folder,
      "MakeNamedMedium \"fog\" \"rgb sigma_s\" [ .1 .2 .3 ] \"rgb sigma_a\" [ .01 .01 0 ] \"float "
      "g\" "
      ".5\nMediumInterface \"\" \"fog\"\n" +
          std::string(kCamera) + "Camera \"perspective\"\n" + kFilm +
          "Integrator \"volpath\" \"integer maxdepth\" 5\nWorldBegin MediumInterface \"fog\"\n"
          "MakeNamedMaterial \"red\" \"string type\" \"diffuse\" \"rgb reflectance\" [ .7 .1 .1 ]\n"
          "MakeNamedMaterial \"clear\" \"string type\" \"thindielectric\"\n"
          "MakeNamedMaterial \"half\" \"string type\" \"mix\" \"string materials\" [ \"red\" "
          "\"clear\" ] \"float amount\" .25\n"
          "NamedMaterial \"half\" ObjectBegin \"ball\" Shape \"cylinder\" \"float radius\" .25 "
          "\"float "
          "zmin\" 0 ObjectEnd\nNamedMaterial \"red\" Shape \"plymesh\" \"string filename\" "
          "\"floor.ply\"\n"
          "AttributeBegin Translate 1 1 0 ObjectInstance \"ball\" AttributeEnd\n"
          "AttributeBegin Translate -1 1 0 Scale 2 2 2 ObjectInstance \"ball\" AttributeEnd\n"
          "LightSource \"point\" \"rgb I\" [ 9 9 9 ] \"point3 from\" [ 0 3 1 ]\n"
          "LightSource \"infinite\" \"rgb L\" [ .1 .2 .3 ]\n",
      "materials:\n"
      "  red: { type: two_sided, bsdf: { type: diffuse, reflectance: [0.7, 0.1, 0.1] } }\n"
      "  clear: { type: thin_dielectric, ior: 1.5 }\n"
      "  half: { type: blend, first: red, second: clear, weight: 0.25 }\n"
      "media:\n  fog: { type: homogeneous, absorption: [0.01, 0.01, 0], scattering: [0.1, 0.2, "
      "0.3], "
      "phase: { type: henyey_greenstein, g: 0.5 } }\n"
      "groups:\n  ball: [{ type: cylinder, radius: 0.25, p0: [0, 0, 0], p1: [0, 0, 1], material: "
      "half "
      "}]\n"
      "shapes:\n"
      "  - { type: mesh, file: floor.ply, material: red }\n"
      "  - { type: instance, group: ball, to_world: { translate: [1, 1, 0] } }\n"
      "  - { type: instance, group: ball, to_world: [{ scale: 2 }, { translate: [-1, 1, 0] }] }\n"
      "emitters:\n"
      "  - { type: point, intensity: [9, 9, 9], position: [0, 3, 1] }\n"
      "  - { type: constant, radiance: [0.1, 0.2, 0.3] }\n"
      "medium: fog\n" +
          std::string(kSensor),
      kRender);
}

TEST_CASE("pbrt: a lens, coats and holes in parallel light") {
  const test::TemporaryFolder folder;
  folder.write("floor.ply", kFloor);
  check_same_image(
      folder,
      std::string(kCamera) +
          "Camera \"perspective\" \"float lensradius\" .125 \"float focaldistance\" 3\n" + kFilm +
          "Integrator \"path\"\nWorldBegin\n"
          "Material \"coateddiffuse\" \"rgb reflectance\" [ .2 .5 .3 ] \"float roughness\" .0625\n"
          "Shape \"plymesh\" \"string filename\" \"floor.ply\"\n"
          "Material \"diffusetransmission\" \"rgb reflectance\" [ .2 .3 .4 ] \"rgb transmittance\" "
          "[ .4 "
          ".3 .2 ]\n"
          "AttributeBegin Translate 0 1 0 Shape \"disk\" \"float radius\" 1 \"float alpha\" .75 "
          "AttributeEnd\n"
          "LightSource \"distant\" \"rgb L\" [ 3 2 1 ] \"point3 from\" [ 0 1 0 ] \"point3 to\" [ 0 "
          "0 0 "
          "]\nLightSource \"infinite\"\n",
      "materials:\n"
      "  coated: { type: two_sided, bsdf: { type: rough_plastic, alpha: 0.25, ior: 1.5, "
      "reflectance: "
      "[0.2, 0.5, 0.3], nonlinear: true } }\n"
      "  paper: { type: diffuse_transmitter, reflectance: [0.2, 0.3, 0.4], transmittance: [0.4, "
      "0.3, "
      "0.2] }\n"
      "shapes:\n"
      "  - { type: mesh, file: floor.ply, material: coated }\n"
      "  - { type: disk, material: { type: mask, bsdf: paper, opacity: 0.75 }, to_world: { "
      "translate: "
      "[0, 1, 0] } }\n"
      "emitters:\n"
      "  - { type: directional, irradiance: [3, 2, 1], direction: [0, -1, 0] }\n"
      "  - { type: constant, radiance: 1 }\n"
      "sensor: { type: thin_lens, fov: 112.619865, aperture_radius: 0.125, focus_distance: 3, "
      "to_world: "
      "{ look_at: { origin: [0, 1, 4], target: [0, 1, 0], up: [0, 1, 0] } } }\n",
      kRender);
}

}  // namespace pharos::testing
