// The view of a scene of pbrt, and the state that its directives change.

#include <cmath>
#include <filesystem>
#include <numbers>

#include "pbrt_test_kit.h"

namespace pharos::pbrt {

using test::import_of, test::import_of_world, test::notes, test::part;

TEST_CASE("pbrt: scenes packed by gzip") {
  // Camera "perspective" / WorldBegin / Shape "plymesh" "string filename" "ball.ply.gz"
  const std::string packed(
      "\x1f\x8b\x08\x00\x00\x00\x00\x00\x02\x03\x0d\x8b\xcd\x0d\x80\x20\x0c\x46\xef\x4c"
      "\x41\x3a\x00\x43\xe8\x08\x1e\x3c\x57\xfd\x84\x26\x05\x49\x31\x26\x3a\xbd\xbd\xbe"
      "\x9f\x99\x2b\x8c\x23\x75\xd8\xe8\xd8\x6f\x79\x40\x61\xbd\x4c\x8f\x09\x59\x5a\x58"
      "\x0a\x77\xb8\xd6\xb7\x62\x14\x8a\x34\x6e\x93\x96\xe3\x29\x8a\xe6\xaf\x93\x8d\x55"
      "\x93\x07\x29\x7f\x14\x7e\x98\x89\xb3\x82\x50\x00\x00\x00",
      94);
  const pharos::test::TemporaryFolder folder;
  const auto import = [&](const std::string& bytes) {
    return PbrtImporter().import(folder.write("scene.pbrt.gz", bytes));
  };
  CHECK(part(import(packed), "scene.shapes.0.file") == "ball.ply.gz");
  const auto refusal = [&](const std::string& bytes) {
    return pharos::test::input_error_in(folder, [&] { import(bytes); });
  };
  CHECK(refusal(packed.substr(0, packed.size() - 12)) ==
        "scene.pbrt.gz: error: its gzip data are cut off");
  std::string damaged = packed;
  damaged[packed.size() - 6] ^= 1;  // the checksum
  CHECK(refusal(damaged) == "scene.pbrt.gz: error: its gzip data are damaged");
  // Two packed files one after the other hold the texts one after the other.
  CHECK(refusal(packed + packed) ==
        "scene.pbrt.gz:4:1: error: Camera must stand before WorldBegin");
}

TEST_CASE("pbrt: a camera looks where pbrt's looks, with x to the right") {
  // Without a transform, pbrt's camera looks along +z with +x on the right. In Pharos +x is on the
  // left, so the camera is mirrored.
  const Import plain = import_of("Camera \"perspective\" WorldBegin");
  CHECK(part(plain, "scene.sensor") ==
        "{ type: perspective, fov: 121.28449, to_world: { matrix: [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, "
        "1, 0] } }");
  const Import placed = import_of(
      "Scale -1 1 1 Translate 0 0 5\nFilm \"rgb\" \"integer xresolution\" 100 \"integer "
      "yresolution\" 100\nCamera \"perspective\" \"float fov\" 40");
  CHECK(part(placed, "scene.sensor") ==
        "{ type: perspective, fov: 40, to_world: { matrix: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, -5] } "
        "}");
}

TEST_CASE("pbrt: fields of view span the shorter edge, or the screen window") {
  const auto fov = [](const std::string& film, const std::string& camera) {
    const Import import = import_of("Film \"rgb\" " + film + " Camera \"perspective\" " + camera);
    return std::stod(part(import, "scene.sensor.fov"));
  };
  const std::string wide = "\"integer xresolution\" 200 \"integer yresolution\" 100 ";
  const std::string tall = "\"integer xresolution\" 100 \"integer yresolution\" 200 ";
  const double degree = std::numbers::pi / 180;
  const double across = 2 * std::atan(2 * std::tan(20 * degree)) / degree;
  CHECK(fov(wide, "\"float fov\" 40") == doctest::Approx(across));
  CHECK(fov(tall, "\"float fov\" 40") == doctest::Approx(40));
  CHECK(fov(wide, "\"float halffov\" 20") == doctest::Approx(across));
  CHECK(fov(wide, "\"float fov\" 40 \"float screenwindow\" [ -2 2 -1 1 ]") ==
        doctest::Approx(across));
  CHECK(fov(wide, "\"float fov\" 40 \"float screenwindow\" [ -1 1 -.5 .5 ]") ==
        doctest::Approx(40));
}

TEST_CASE("pbrt: lenses, and cameras without a counterpart") {
  const Import lens = import_of(
      "Camera \"perspective\" \"float lensradius\" .1 \"float focaldistance\" 3 \"float fov\" 40");
  CHECK(part(lens, "scene.sensor.type") == "thin_lens");
  CHECK(part(lens, "scene.sensor.aperture_radius") == "0.1");
  CHECK(part(lens, "scene.sensor.focus_distance") == "3");
  const Import flat =
      import_of("Camera \"orthographic\" \"float screenwindow\" [ -3 3 -1.6875 1.6875 ]");
  CHECK(part(flat, "scene.sensor.width") == "6");
  CHECK(notes(flat).empty());
  CHECK(notes(import_of("Camera \"spherical\"")) ==
        std::vector<std::string>{"Camera spherical: replaced by a perspective camera with 50 "
                                 "degrees across the shorter edge"});
}

TEST_CASE("pbrt: film, filter, sampler and integrator") {
  const Import standard = import_of("Camera \"perspective\"");
  CHECK(part(standard, "film") ==
        "{ width: 1280, height: 720, filter: { type: gaussian, radius: 1.5, stddev: 0.5 } }");
  CHECK(part(standard, "sampler") == "z_sobol");
  CHECK(part(standard, "budget") == "{ spp: 16 }");
  CHECK(part(standard, "integrator") == "{ type: path, max_depth: 6, termination: throughput }");

  const Import stated = import_of(
      "Film \"gbuffer\" \"integer xresolution\" 200 \"integer yresolution\" 100 \"float "
      "cropwindow\" "
      "[ .25 .75 0 .5 ] \"float iso\" 200\nPixelFilter \"sinc\"\nSampler \"stratified\" \"integer "
      "xsamples\" 3\nIntegrator \"bdpt\" \"integer maxdepth\" 10 \"bool visualize\" true");
  CHECK(part(stated, "film.crop") == "{ x: 50, y: 0, width: 100, height: 50 }");
  CHECK(part(stated, "film.filter") == "{ type: lanczos, lobes: 3 }");
  CHECK(part(stated, "sampler") == "stratified");
  CHECK(part(stated, "budget.spp") == "12");
  CHECK(part(stated, "integrator.max_depth") == "11");
  CHECK(notes(stated) == std::vector<std::string>{"Film gbuffer: pbrt's image is 2 times as bright",
                                                  "PixelFilter sinc: has 3 lobes",
                                                  "the scene has no Camera",
                                                  "Integrator bdpt: replaced by path"});
}

TEST_CASE("pbrt: objects and instances") {
  const Import import = import_of_world(
      "ObjectBegin \"ball\" Translate 0 0 1 Shape \"sphere\" ObjectEnd\nObjectBegin \"nothing\" "
      "ObjectEnd\n"
      "Scale 2 2 2 ObjectInstance \"ball\" ObjectInstance \"nothing\"");
  CHECK(part(import, "scene.groups.ball.0.to_world") ==
        "{ matrix: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 1] }");
  CHECK(part(import, "scene.shapes.0") ==
        "{ type: instance, group: ball, to_world: { matrix: [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0] } "
        "}");
  CHECK(part(import, "scene.shapes.1") == "none");
}

TEST_CASE("pbrt: transforms follow each other as in pbrt") {
  const auto matrix = [](const std::string& steps) {
    return part(import_of_world(steps + " Shape \"disk\""), "scene.shapes.0.to_world.matrix");
  };
  CHECK(matrix("Translate 1 0 0 Scale 2 2 2") == "[2, 0, 0, 1, 0, 2, 0, 0, 0, 0, 2, 0]");
  CHECK(matrix("Rotate 90 0 0 1") == "[0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0]");
  CHECK(matrix("Translate 5 5 5 Transform [ 1 0 0 0  0 2 0 0  0 0 3 0  4 5 6 1 ]") ==
        "[1, 0, 0, 4, 0, 2, 0, 5, 0, 0, 3, 6]");
  CHECK(matrix("Translate 1 1 1 ConcatTransform [ 2 0 0 0  0 2 0 0  0 0 2 0  0 0 0 1 ]") ==
        "[2, 0, 0, 1, 0, 2, 0, 1, 0, 0, 2, 1]");
  CHECK(
      matrix(
          "Translate 1 1 1 CoordinateSystem \"a\" Identity Scale 3 3 3 CoordSysTransform \"a\"") ==
      "[1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1]");
  CHECK(matrix("TransformBegin Scale 3 3 3 TransformEnd Translate 1 0 0") ==
        "[1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0]");
  CHECK(matrix("ActiveTransform EndTime Scale 3 3 3 ActiveTransform All Translate 1 0 0") ==
        "[1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0]");
}

TEST_CASE("pbrt: options have no type, and the shutter is the exposure") {
  const Import import = import_of(
      "Option \"seed\" 3 Option \"rendercoordsys\" \"world\" Option \"forcediffuse\" true\n"
      "Film \"rgb\" \"float iso\" 200 Camera \"perspective\" \"float shutterclose\" .5");
  CHECK(notes(import) == std::vector<std::string>{"the option 'forcediffuse' is left out"});
  CHECK(part(import_of("Sampler \"independent\""), "budget.spp") == "4");
}

TEST_CASE("pbrt: what blocks save, and what WorldBegin resets") {
  // Only the camera moves; after WorldBegin, transforms apply to the start of the exposure again.
  const Import moving = import_of(
      "ActiveTransform EndTime Translate 0 0 1 Camera \"perspective\" WorldBegin Translate 1 0 0 "
      "Shape \"disk\"");
  CHECK(part(moving, "scene.shapes.0.to_world.matrix") == "[1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0]");
  const Import saved = import_of_world(
      "AttributeBegin ActiveTransform EndTime Attribute \"shape\" \"float radius\" 3 "
      "AreaLightSource \"diffuse\" AttributeEnd Translate 1 0 0 Shape \"disk\"\n"
      "AreaLightSource \"diffuse\" Shape \"disk\" AreaLightSource \"\" Shape \"disk\"\n"
      "Material \"interface\" AreaLightSource \"diffuse\" Shape \"disk\"");
  CHECK(part(saved, "scene.shapes.0.to_world.matrix") == "[1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0]");
  CHECK(part(saved, "scene.shapes.0.emitter") == "none");
  CHECK(part(saved, "scene.shapes.1.emitter") == "{ type: area, radiance: 1 }");
  CHECK(part(saved, "scene.shapes.2.emitter") == "none");
  CHECK(part(saved, "scene.shapes.3.emitter") == "none");
}

TEST_CASE("pbrt: files in files") {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "parts");
  folder.write(
      "parts/a.pbrt",
      "Translate 1 0 0\nTexture \"w\" \"float\" \"imagemap\" \"string filename\" \"w.png\"");
  folder.write("parts/b.pbrt",
               "Translate 5 0 0\nShape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ]");
  const Import import = PbrtImporter().import(folder.write(
      "scene.pbrt", "WorldBegin\nImport \"parts/b.pbrt\" Include \"parts/a.pbrt\" Shape \"disk\""));
  const std::string mesh = part(import, "scene.shapes.0");
  CHECK(mesh.find("file: b.pbrt, part: \"2:1\"") != std::string::npos);
  const ConfigNode& file = *import.config.find("scene")->find("shapes")->items()[0].find("file");
  CHECK(std::filesystem::path(file.where().file).parent_path() == folder / "parts");
  CHECK(part(import, "scene.shapes.1.to_world.matrix") == "[1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0]");
  CHECK(part(import, "scene.textures.w.file") == (folder / "w.png").string());
}

TEST_CASE("pbrt: what is left out is said, once for each kind") {
  const Import import = import_of_world(
      "Shape \"sphere\" \"float squash\" 1 Shape \"sphere\" \"float squash\" 2\n"
      "AreaLightSource \"diffuse\" \"bool twosided\" true Shape \"sphere\"");
  CHECK(notes(import) ==
        std::vector<std::string>{"Shape sphere: 'squash' is left out",
                                 "AreaLightSource diffuse: emits on the side of the normal only"});
  CHECK(import.notes[0].times == 2);
  CHECK(import.objects[2].what == "shape sphere");
}

}  // namespace pharos::pbrt
