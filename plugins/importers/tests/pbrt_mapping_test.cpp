// What stands in a config for the objects of pbrt.

#include <cmath>
#include <filesystem>

#include <pharos/core/image.h>

#include "pbrt_test_kit.h"

namespace pharos::pbrt {
namespace {

using test::import_of, test::import_of_world, test::notes, test::part;

std::string material(const std::string& parameters) {
  return part(import_of_world("Material " + parameters + "\nShape \"sphere\""),
              "scene.materials.material");
}

std::string light(const std::string& parameters) {
  return part(import_of_world("LightSource " + parameters), "scene.emitters.0");
}

std::string shape(const std::string& world) {
  return part(
      import_of_world("NamedMaterial \"m\" MakeNamedMaterial \"m\" \"string type\" \"diffuse\"\n" +
                      world),
      "scene.shapes.0");
}

std::string texture(const std::string& parameters) {
  return part(import_of_world("Texture \"t\" " + parameters), "scene.textures.t");
}

bool is_near(Rgb a, Rgb b, float tolerance) {
  return max_component(Rgb(std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b))) <=
         tolerance;
}

/// Returns the color of the only light, of intensity 1 by luminance.
Rgb light_color(const std::string& type, const std::string& value) {
  const Import import = import_of_world("LightSource \"point\" \"" + type + " I\" " + value);
  const ConfigNode* list =
      import.config.find("scene")->find("emitters")->items()[0].find("intensity");
  Rgb color;
  for (int c = 0; c < 3; ++c)
    color[c] = std::stof(list->items()[static_cast<std::size_t>(c)].text());
  return color;
}

Rgb surface_color(const std::string& value) {
  const Import import = import_of_world("Material \"diffuse\" \"spectrum reflectance\" " + value);
  const ConfigNode* list = import.config.find("scene")
                               ->find("materials")
                               ->find("material")
                               ->find("bsdf")
                               ->find("reflectance");
  Rgb color;
  for (int c = 0; c < 3; ++c)
    color[c] = std::stof(list->items()[static_cast<std::size_t>(c)].text());
  return color;
}

}  // namespace

TEST_CASE("pbrt: materials") {
  CHECK(material("\"diffuse\" \"rgb reflectance\" [ .1 .2 .3 ]") ==
        "{ type: two_sided, bsdf: { type: diffuse, reflectance: [0.1, 0.2, 0.3] } }");
  CHECK(material("\"conductor\" \"float roughness\" .04 \"spectrum eta\" \"metal-Ag-eta\" "
                 "\"spectrum k\" \"metal-Ag-k\"") ==
        "{ type: two_sided, bsdf: { type: rough_conductor, alpha: 0.2, eta: [0.056, 0.055, 0.043], "
        "k: [4.35, 3.53, 2.57] } }");
  CHECK(material("\"conductor\" \"float uroughness\" .3 \"float vroughness\" .1 \"bool "
                 "remaproughness\" false \"rgb reflectance\" [ .5 .8 .9 ]") ==
        "{ type: two_sided, bsdf: { type: rough_conductor, alpha: 0.3, alpha_v: 0.1, eta: 1, k: "
        "[2, 4, 5.999999] } }");
  CHECK(material("\"dielectric\" \"spectrum eta\" \"glass-BK7\"") ==
        "{ type: dielectric, ior: 1.5168 }");
  CHECK(material("\"dielectric\" \"float roughness\" .25") ==
        "{ type: rough_dielectric, alpha: 0.5, ior: 1.5 }");
  CHECK(material("\"thindielectric\"") == "{ type: thin_dielectric, ior: 1.5 }");
  CHECK(material("\"coateddiffuse\" \"rgb reflectance\" [ .1 .2 .3 ]") ==
        "{ type: two_sided, bsdf: { type: plastic, ior: 1.5, reflectance: [0.1, 0.2, 0.3], "
        "nonlinear: true } }");
  CHECK(material("\"coateddiffuse\" \"float roughness\" .01") ==
        "{ type: two_sided, bsdf: { type: rough_plastic, alpha: 0.1, ior: 1.5, reflectance: 0.5, "
        "nonlinear: true } }");
  CHECK(material("\"coatedconductor\" \"float conductor.roughness\" .01") ==
        "{ type: two_sided, bsdf: { type: rough_conductor, alpha: 0.1, eta: [0.179, 1.041, 1.29], "
        "k: [3.27, 2.6, 2.37] } }");
  CHECK(material("\"diffusetransmission\" \"float scale\" .5") ==
        "{ type: diffuse_transmitter, reflectance: { type: scale, texture: 0.25, factor: 0.5 }, "
        "transmittance: { type: scale, texture: 0.25, factor: 0.5 } }");
  CHECK(material("\"interface\"") == "{ type: pass_through }");
  CHECK(material("\"\"") == "{ type: pass_through }");
  CHECK(material("\"hair\"") == "{ type: two_sided, bsdf: { type: diffuse } }");
}

TEST_CASE("pbrt: named materials may be used before they are defined, and mixed") {
  const Import import = import_of_world(
      "MakeNamedMaterial \"both\" \"string type\" \"mix\" \"string materials\" [ \"a b\" \"true\" "
      "] "
      "\"float amount\" .25\nNamedMaterial \"both\" Shape \"disk\"\nMakeNamedMaterial \"a b\" "
      "\"string type\" \"dielectric\"\nMakeNamedMaterial \"true\" \"string type\" \"diffuse\"");
  CHECK(part(import, "scene.materials.both") ==
        "{ type: blend, first: a_b, second: material_true, weight: 0.25 }");
  CHECK(part(import, "scene.materials.a_b") == "{ type: dielectric, ior: 1.5 }");
  CHECK(part(import, "scene.shapes.0.material") == "both");
  CHECK(notes(import).empty());
}

TEST_CASE("pbrt: relief and holes") {
  CHECK(material("\"diffuse\" \"string normalmap\" \"n.png\"") ==
        "{ type: normal_map, texture: { type: bitmap, file: n.png, color_space: linear }, bsdf: { "
        "type: two_sided, bsdf: { type: diffuse, reflectance: 0.5 } } }");
  CHECK(shape("Shape \"disk\" \"float alpha\" .25") ==
        "{ type: disk, material: { type: mask, bsdf: m, opacity: 0.25 } }");
}

TEST_CASE("pbrt: textures") {
  CHECK(texture("\"spectrum\" \"constant\" \"rgb value\" [ 1 .5 0 ]") ==
        "{ type: constant, value: [1, 0.5, 0] }");
  CHECK(texture("\"float\" \"scale\" \"float tex\" .5 \"float scale\" 3") ==
        "{ type: scale, texture: 0.5, factor: 3 }");
  CHECK(texture("\"spectrum\" \"mix\" \"rgb tex1\" [ 1 0 0 ] \"float amount\" .25") ==
        "{ type: mix, first: [1, 0, 0], second: 1, weight: 0.25 }");
  CHECK(texture("\"float\" \"checkerboard\" \"float uscale\" 8 \"float vscale\" 2") ==
        "{ type: mix, first: 1, second: 0, weight: { type: checkerboard, color0: 0, color1: 1, "
        "uv_scale: [4, 1] } }");
  CHECK(texture(
            "\"spectrum\" \"imagemap\" \"string filename\" \"wood.png\" \"string wrap\" \"clamp\" "
            "\"string encoding\" \"linear\" \"float udelta\" .5 \"float scale\" 2") ==
        "{ type: scale, texture: { type: uv_map, texture: { type: bitmap, file: wood.png, wrap: "
        "clamp, color_space: linear }, matrix: [1, 0, 0.5, 0, 1, 0] }, factor: 2 }");
  CHECK(texture("\"float\" \"imagemap\" \"string filename\" \"wood.png\" \"bool invert\" true") ==
        "{ type: mix, first: 1, second: 0, weight: { type: bitmap, file: wood.png } }");
  CHECK(texture("\"float\" \"bilerp\" \"float v11\" 3") == "{ type: constant, value: [1, 1, 1] }");
  CHECK(texture("\"float\" \"fbm\" \"integer octaves\" 3") == "{ type: constant, value: 0.5 }");
}

TEST_CASE("pbrt: a texture of roughness is replaced by its mean") {
  const auto alpha = [](const std::string& rough) {
    const Import import = import_of_world("Texture \"r\" \"float\" " + rough +
                                          "\nMaterial \"dielectric\" \"texture roughness\" \"r\" "
                                          "\"bool remaproughness\" false");
    return part(import, "scene.materials.material.alpha");
  };
  CHECK(alpha("\"constant\" \"float value\" .3") == "0.3");
  CHECK(alpha("\"checkerboard\" \"float tex1\" .1 \"float tex2\" .3") == "0.20000002");
  CHECK(alpha("\"mix\" \"float tex1\" .4 \"float tex2\" .8") == "0.6");

  const test::TemporaryFolder folder;
  Image image(2, 1, {"R", "G", "B"});
  image.set_rgb(0, 0, Rgb(0.5f));
  write_exr(image, folder / "r.exr");
  const Import import =
      PbrtImporter().import(folder.write("scene.pbrt",
                                         "WorldBegin Texture \"r\" \"float\" \"imagemap\" \"string "
                                         "filename\" \"r.exr\" \"float scale\" 2\n"
                                         "Material \"dielectric\" \"texture roughness\" \"r\""));
  CHECK(part(import, "scene.materials.material.alpha") == "0.70710677");
}

TEST_CASE("pbrt: lights") {
  CHECK(light("\"point\" \"rgb I\" [ 1 2 3 ] \"point3 from\" [ 1 2 3 ]") ==
        "{ type: point, intensity: [1, 2, 3], position: [1, 2, 3] }");
  CHECK(light("\"point\" \"float power\" 100") ==
        "{ type: point, intensity: 1, scale: 7.957747, position: [0, 0, 0] }");
  CHECK(light("\"distant\" \"point3 to\" [ 0 -2 0 ] \"float illuminance\" 5") ==
        "{ type: directional, irradiance: 1, scale: 5, direction: [0, -1, 0] }");
  CHECK(light("\"infinite\" \"rgb L\" [ 1 2 3 ] \"float scale\" .5") ==
        "{ type: constant, radiance: [1, 2, 3], scale: 0.5 }");
  CHECK(light("\"infinite\" \"string filename\" \"sky.exr\" \"float scale\" 2") ==
        "{ type: environment_map, file: sky.exr, layout: equal_area, scale: 2, to_world: { matrix: "
        "[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0] } }");
  CHECK(
      light("\"spot\" \"float coneangle\" 40 \"float conedeltaangle\" 10") ==
      "{ type: spot, intensity: 1, cutoff_angle: 40, beam_width: 30, falloff: smooth, to_world: { "
      "matrix: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0] } }");
  CHECK(light("\"goniometric\" \"rgb I\" [ 1 2 3 ] \"string filename\" \"a.exr\"") ==
        "{ type: point, intensity: [1, 2, 3], position: [0, 0, 0] }");
}

TEST_CASE("pbrt: the power of a spot is what it sends out") {
  // The intensity falls as 3 t^2 - 2 t^3 of the cosine, whose mean over the ring is a half.
  const std::string spot =
      light("\"spot\" \"float coneangle\" 60 \"float conedeltaangle\" 60 \"float power\" 10");
  CHECK(spot.find("scale: 6.3661976,") != std::string::npos);  // 10 / (2 pi (1 - 1/2) / 2)
}

TEST_CASE("pbrt: shapes carry the matrix, the side and the light of the state") {
  CHECK(shape("Translate 1 2 3 Shape \"sphere\" \"float radius\" 2") ==
        "{ type: sphere, radius: 2, to_world: { matrix: [1, 0, 0, 1, 0, 1, 0, 2, 0, 0, -1, 3] }, "
        "material: m }");
  CHECK(
      shape(
          "AttributeBegin Translate 1 2 3 AttributeEnd ReverseOrientation AreaLightSource "
          "\"diffuse\" \"rgb L\" [ 1 2 3 ] Shape \"disk\" \"float radius\" 2 \"float height\" 1") ==
      "{ type: disk, to_world: { matrix: [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 1] }, flip_normals: "
      "true, material: m, emitter: { type: area, radiance: [1, 2, 3] } }");
  CHECK(shape("Attribute \"shape\" \"float radius\" 3 Shape \"cylinder\" \"float zmin\" 0") ==
        "{ type: cylinder, radius: 3, p0: [0, 0, 0], p1: [0, 0, 1], material: m }");
  CHECK(shape("\nShape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ]") ==
        "{ type: mesh, file: scene.pbrt, part: \"5:1\", material: m }");
  CHECK(shape("Shape \"plymesh\" \"string filename\" \"meshes/a.ply\"") ==
        "{ type: mesh, file: meshes/a.ply, material: m }");
  CHECK(shape("Shape \"curve\"") == "none");
}

TEST_CASE("pbrt: parts of spheres, and stretched ones, are surfaces of revolution") {
  const Import import = import_of_world("Scale 1 2 1 Shape \"sphere\" \"float zmin\" 0");
  CHECK(part(import, "scene.shapes.0.type") == "lathe");
  CHECK(part(import, "scene.shapes.0.profile.0") == "[1, 6.123234e-17]");
  CHECK(part(import, "scene.shapes.0.profile.64") == "[0, 1]");
  CHECK(notes(import).size() == 1);
}

TEST_CASE("pbrt: media on both sides of a shape, and around the camera") {
  const Import import = import_of(
      "MakeNamedMedium \"air\" \"rgb sigma_s\" [ 1 2 3 ] \"rgb sigma_a\" [ 0 0 0 ] \"float g\" .5\n"
      "MakeNamedMedium \"smoke\" \"string type\" \"uniformgrid\" \"float density\" [ 1 2 ]\n"
      "MediumInterface \"\" \"air\" Camera \"perspective\" WorldBegin\n"
      "Shape \"sphere\" MediumInterface \"smoke\" \"\" Shape \"sphere\" MediumInterface \"air\" "
      "Shape \"sphere\"");
  CHECK(part(import, "scene.medium") == "air");
  CHECK(part(import, "scene.media.air") ==
        "{ type: homogeneous, absorption: [0, 0, 0], scattering: [1, 2, 3], phase: { type: "
        "henyey_greenstein, g: 0.5 } }");
  CHECK(part(import, "scene.shapes.0.exterior") == "air");
  CHECK(part(import, "scene.shapes.0.interior") == "none");
  CHECK(part(import, "scene.shapes.1.interior") == "none");
  CHECK(part(import, "scene.shapes.2.interior") == "none");  // the same on both sides
}

TEST_CASE(
    "pbrt: textures of both types may have one name, and the last of equal parameters counts") {
  const Import import = import_of_world(
      "Texture \"t\" \"spectrum\" \"constant\" Texture \"t\" \"float\" \"constant\" \"float "
      "value\" .25\nMaterial \"mix\" \"texture amount\" \"t\" \"string materials\" [ \"a\" \"a\" "
      "]\n"
      "MakeNamedMaterial \"a\" \"string type\" \"diffuse\" \"texture reflectance\" \"t\"\n"
      "Shape \"sphere\" \"float radius\" 2 \"float radius\" 3");
  CHECK(part(import, "scene.materials.material.weight") == "t_2");
  CHECK(part(import, "scene.materials.a.bsdf.reflectance") == "t");
  CHECK(part(import, "scene.shapes.0.radius") == "3");
}

TEST_CASE("pbrt: textures made of textures need no more time than there are of them") {
  std::string world = "Texture \"t0\" \"float\" \"constant\" \"float value\" 1\n";
  for (int i = 1; i <= 60; ++i) {
    world += "Texture \"t" + std::to_string(i) + "\" \"float\" \"scale\" \"texture tex\" \"t" +
             std::to_string(i - 1) + "\" \"texture scale\" \"t" + std::to_string(i - 1) + "\"\n";
  }
  const Import import =
      import_of_world(world + "Material \"dielectric\" \"texture roughness\" \"t60\"");
  CHECK(part(import, "scene.materials.material.alpha") == "1");
}

TEST_CASE("pbrt: a light's spectrum tells its color, not its brightness") {
  // Luminance 1, whatever the values; colors from the chromaticities that tables give.
  for (const char* kelvin : {"3000", "6500", "10000"}) {
    CHECK(luminance(light_color("blackbody", kelvin)) == doctest::Approx(1).epsilon(1e-3));
  }
  const auto relative = [](Rgb c) { return c / max_component(c); };
  CHECK(is_near(relative(light_color("blackbody", "3000")), {1, 0.477f, 0.154f}, 0.02f));
  CHECK(is_near(relative(light_color("blackbody", "10000")), {0.6036f, 0.7048f, 1}, 0.02f));
  CHECK(is_near(light_color("spectrum", "\"stdillum-D65\""), Rgb(1), 0.002f));
  CHECK(is_near(relative(light_color("spectrum", "\"stdillum-A\"")), {1, 0.448f, 0.126f}, 0.02f));
  CHECK(is_near(light_color("spectrum", "[ 300 7 900 7 ]"),
                light_color("spectrum", "[ 300 1 900 1 ]"), 1e-5f));
}

TEST_CASE("pbrt: a surface's spectrum is seen in daylight") {
  CHECK(is_near(surface_color("[ 300 .4 900 .4 ]"), Rgb(0.4f), 0.001f));
  // By NumPy, with the tabulated observer and D65: a ramp from 0 at 400 nm to 1 at 700 nm.
  CHECK(is_near(surface_color("[ 400 0 700 1 ]"), {0.8057f, 0.4769f, 0.1362f}, 0.004f));
}

TEST_CASE("pbrt: color spaces") {
  const auto in = [](const std::string& space, const std::string& rgb) {
    const Import import = import_of_world("ColorSpace \"" + space +
                                          "\" Material \"diffuse\" \"rgb reflectance\" " + rgb);
    return part(import, "scene.materials.material.bsdf.reflectance");
  };
  CHECK(in("srgb", "[ .1 .2 .3 ]") == "[0.1, 0.2, 0.3]");
  CHECK(in("rec2020", "[ .5 .5 .5 ]") == "[0.5, 0.5, 0.5]");
  CHECK(in("dci-p3", "[ 0 .5 0 ]") == "[0, 0.5210285, 0]");
}

}  // namespace pharos::pbrt
