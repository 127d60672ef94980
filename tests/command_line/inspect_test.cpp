// Inspection of learned models from the command line: facts, pictures, mistakes.

#include <cmath>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <pharos/core/image.h>

#include "learned_model.h"
#include "refusal.h"

namespace pharos::testing {
namespace {

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

Outcome inspect(const ScratchFolder& folder, const std::string& arguments) {
  return run_pharos("inspect " + arguments, folder.path(), kStandIns);
}

Mistake mistake(const std::string& arguments) {
  return {.arguments = "inspect " + arguments,
          .prepare = write_learned_model,
          .environment = kStandIns};
}

/// Returns the picture that `inspect box.model ARGUMENTS -o FILE` makes. Checks that no other file
/// is written.
Image picture(const ScratchFolder& folder, const std::string& arguments, const std::string& file) {
  const std::size_t before = folder.file_count();
  const Outcome outcome = inspect(folder, fmt::format("box.model {} -o {}", arguments, file));
  CAPTURE(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK(outcome.out.empty());
  CHECK(contains(outcome.err, file + ": "));
  CHECK(folder.file_count() == before + 1);
  return read_image(folder.path() / file);
}

bool is_white(const Image& image, int x, int y) {
  return image.rgb(x, y) == Rgb(1);
}

/// Returns the white columns of a row.
std::vector<int> white_columns(const Image& image, int y) {
  std::vector<int> columns;
  for (int x = 0; x < image.width(); ++x) {
    if (is_white(image, x, y)) columns.push_back(x);
  }
  return columns;
}

TEST_CASE("inspect: what a model tells of itself") {
  const ScratchFolder folder;
  write_learned_model(folder);
  const auto before = folder.listing();
  const Outcome outcome = inspect(folder, "box.model");
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err.empty());
  for (const char* part :
       {"model    stub_segments, version 1\n", "learner  stub_segments\n", "saved    1032 bytes\n",
        "memory   1000 bytes\n", "bounds   (-2, -1, -1) to (2, 1, 1)\n", "regions  1\n",
        "voxels   125\n"}) {
    CAPTURE(part);
    CHECK(contains(outcome.out, part));
  }
  CHECK(folder.listing() == before);
}

TEST_CASE("inspect --slice: pictures and numbers") {
  const ScratchFolder folder;
  write_learned_model(folder);
  const Image z = picture(folder, "--slice z=0.1 --size 80", "z.png");
  CHECK(z.width() == 80);
  CHECK(z.height() == 40);
  const Image x = picture(folder, "--slice x=-0.5 --size 50", "x.png");
  CHECK(x.width() == 50);
  CHECK(x.height() == 50);
  const Image numbers = picture(folder, "--slice y=0 --size 80", "y.exr");
  CHECK(numbers.width() == 80);
  CHECK(numbers.height() == 40);
  CHECK(numbers.channels() == std::vector<std::string>{"Y"});
  CHECK(read_metadata(folder.path() / "y.exr")
            .at("pharos:caption")
            .find("density at y = 0, x to the right, z down; densest at (") == 0);
  // A grid with five voxels per edge. Their values sum to one.
  CHECK(*numbers.pixel(3, 3) == *numbers.pixel(12, 5));
  CHECK(*numbers.pixel(3, 3) != *numbers.pixel(20, 5));
  CHECK(*numbers.pixel(40, 20) > 0);
}

TEST_CASE("inspect --range: the colors' scale is said, and may be stated") {
  const ScratchFolder folder;
  write_learned_model(folder);
  const Outcome own = inspect(folder, "box.model --slice z=0 --size 32 -o own.png");
  CHECK(contains(own.err, ", logarithmic\n"));
  const Outcome stated =
      inspect(folder, "box.model --slice z=0 --size 32 --range 1e-9,1e-8 -o stated.png");
  CHECK(contains(stated.err, "from 1e-09 to 1e-08, logarithmic\n"));
  const Image bright = read_image(folder.path() / "stated.png");
  // All values exceed the scale. A few pixels are of the ring around the densest place.
  int others = 0;
  for (int y = 0; y < bright.height(); ++y) {
    for (int x = 0; x < bright.width(); ++x) others += bright.rgb(x, y) != bright.rgb(0, 0) ? 1 : 0;
  }
  CHECK(others > 0);
  CHECK(others < bright.width() * bright.height() / 4);
}

TEST_CASE("inspect --scene: white lines where the slice cuts the scene") {
  const ScratchFolder folder;
  write_learned_model(folder);
  // 20 pixels per unit: the ball's edge crosses the middle row at 2 +- 0.5, and the walls are at 0
  // and 4.
  const Image cut = picture(folder, "--slice z=0 --size 80 --scene box.yaml", "cut.png");
  for (const int x : white_columns(cut, 20)) {
    CAPTURE(x);
    const double units = (x + 0.5) / 20;
    CHECK((units < 0.06 || units > 3.94 || std::abs(std::abs(units - 2) - 0.5) < 0.06));
  }
  CHECK(is_white(cut, 0, 20));
  CHECK(is_white(cut, 79, 20));
  CHECK((is_white(cut, 29, 20) || is_white(cut, 30, 20)));
  CHECK((is_white(cut, 49, 20) || is_white(cut, 50, 20)));
  CHECK(white_columns(cut, 0).size() == 80);  // the ceiling
  CHECK(white_columns(cut, 5).size() == 2);   // above the ball
  // There is no circle if the slice misses the ball. `--scene` also accepts a config instead of a
  // scene.
  const Image off = picture(folder, "--slice z=0.7 --size 80 --scene train.yaml", "off.png");
  CHECK(white_columns(off, 20).size() == 2);
}

TEST_CASE("inspect --direction: a picture of the sphere of directions") {
  const ScratchFolder folder;
  write_learned_model(folder);
  const Image directions = picture(folder, "--direction -1,0.5,0.25 --size 64", "d.png");
  CHECK(directions.width() == 64);
  CHECK(directions.height() == 32);
  picture(folder, "--direction=0,0,0 --size 64", "d.exr");
}

TEST_CASE("inspect --cloud: a view of its own, or the camera's") {
  const ScratchFolder folder;
  write_learned_model(folder);
  const Image own = picture(folder, "--cloud --size 48", "own.png");
  CHECK(own.width() == 48);
  CHECK(own.height() == 48);
  const Image seen = picture(folder, "--cloud --size 48 --scene train.yaml", "seen.png");
  CHECK(seen.width() == 48);
  CHECK(seen.height() == 32);
  const Image square = picture(folder, "--cloud --size 48 --scene box.yaml", "square.exr");
  CHECK(square.height() == 48);
}

/// Writes box.yaml, train.yaml and a box.model with spatial Gaussians into `folder`.
void write_gaussians(const ScratchFolder& folder) {
  folder.write("box.yaml", box_scene());
  std::string config = training_config("spatial_gaussians");
  const std::string guider = "guider: spatial_gaussians";
  config.replace(config.find(guider), guider.size(), "guider: p0");
  folder.write("train.yaml", config);
  REQUIRE(run_pharos("render train.yaml -q", folder.path(), "").exit_code == 0);
}

TEST_CASE("inspect --ellipsoids: the Gaussians around a point, in the camera's view") {
  const ScratchFolder folder;
  write_gaussians(folder);
  const std::string at = "--ellipsoids 1,0.9,0.5 --size 48 --scene ";
  const Image drawn = picture(folder, at + "train.yaml", "drawn.png");
  CHECK(drawn.width() == 48);
  CHECK(drawn.height() == 32);
  CHECK(picture(folder, at + "box.yaml", "square.png").height() == 48);
  const Image one = picture(folder, at + "train.yaml --threads 1", "one.png");
  CHECK(one.values() == drawn.values());
  const Outcome outcome = inspect(folder, "box.model");
  CHECK(contains(outcome.out, "components"));
}

TEST_CASE("inspect --ellipsoids: what cannot be drawn") {
  check_refused(mistake("box.model --ellipsoids 0,0,0 -o x.png"),
                {"'stub_segments' has no spatial Gaussians", "--slice"});
  check_refused(mistake("box.model --ellipsoids 0,0 -o x.png"),
                {"--ellipsoids 0,0: error: ", "three numbers"});
  check_refused(mistake("box.model --ellipsoids 0,0,0 -o x.exr"), {"x.exr: error: ", ".png"});
  check_refused(mistake("box.model --ellipsoids 0,0,0 --range 1,2 -o x.png"), {"--range: error: "});
  check_refused(mistake("box.model --ellipsoids 0,0,0 --cloud -o x.png"),
                {"--ellipsoids", "--cloud"});
  check_refused(
      {.arguments = "inspect box.model --ellipsoids 0,0,0 -o x.png", .prepare = write_gaussians},
      {"'spatial_gaussians' does not say where it is", "--scene"});
}

TEST_CASE("inspect: the same picture for any number of threads") {
  const ScratchFolder folder;
  write_learned_model(folder);
  for (const char* what : {"--slice z=0.2 --scene box.yaml", "--cloud --scene box.yaml"}) {
    const Image one = picture(folder, fmt::format("{} --size 64 --threads 1", what), "1.png");
    const Image three = picture(folder, fmt::format("{} --size 64 --threads 3", what), "3.png");
    CHECK(one.values() == three.values());
    std::filesystem::remove(folder.path() / "1.png");
    std::filesystem::remove(folder.path() / "3.png");
  }
}

TEST_CASE("inspect: files that are no models") {
  check_refused(mistake("bx.model"), {"'bx.model'", "did you mean 'box.model'?"});
  check_refused(mistake("."), {"found a folder"});
  check_refused(mistake("box.yaml"), {"'box.yaml' is no model of Pharos"});
  check_refused({.arguments = "inspect box.model", .prepare = write_learned_model},
                {"'stub_segments'", "which no module here has"});
}

TEST_CASE("inspect: slices and points that cannot be") {
  for (const char* slice : {"w=1", "z", "z:1", "=1", "xy=1", "''"}) {
    CAPTURE(slice);
    check_refused(mistake(fmt::format("box.model --slice {} -o x.png", slice)),
                  {"--slice", "error: "});
  }
  check_refused(mistake("box.model --slice z=one -o x.png"), {"--slice z=one: error: ", "'one'"});
  check_refused(mistake("box.model --slice z=nan -o x.png"), {"--slice z=nan: error: "});
  check_refused(mistake("box.model --slice z=1.5 -o x.png"),
                {"--slice z=1.5: error: ", "within the model's bounds, -1 to 1"});
  check_refused(mistake("box.model --direction 1,2 -o x.png"),
                {"--direction 1,2: error: ", "three numbers"});
  check_refused(mistake("box.model --direction 1,2,x -o x.png"), {"--direction 1,2,x: error: "});
}

TEST_CASE("inspect: options that do not fit together") {
  check_refused(mistake("box.model -o x.png"), {"--output: error: ", "--slice"});
  check_refused(mistake("box.model --slice z=0"), {"--output: error: ", "expected the name"});
  check_refused(mistake("box.model --slice z=0 --cloud -o x.png"), {"--slice", "--cloud"});
  check_refused(mistake("box.model --direction 0,0,0 --scene box.yaml -o x.png"),
                {"--scene: error: "});
  check_refused(mistake("box.model --slice z=0 --range 2,1 -o x.png"),
                {"--range 2,1: error: ", "LOW < HIGH"});
  check_refused(mistake("box.model --slice z=0 --range 1,2 -o x.exr"), {"--range: error: "});
  check_refused(mistake("box.model --slice z=0 --size 4 -o x.png"), {"--size", "4"});
  check_refused(mistake("box.model --slcie z=0 -o x.png"), {"--slcie"});
}

TEST_CASE("inspect: pictures that cannot be written, scenes that cannot be read") {
  check_refused(mistake("box.model --slice z=0 -o x.jpg"), {"x.jpg: error: ", ".png", ".exr"});
  check_refused(mistake("box.model --slice z=0 -o none/x.png"), {"'none' does not exist"});
  check_refused({.arguments = "inspect model.png --slice z=0 -o ./model.png",
                 .prepare =
                     [](const ScratchFolder& f) {
                       write_learned_model(f);
                       std::filesystem::rename(f.path() / "box.model", f.path() / "model.png");
                     },
                 .environment = kStandIns},
                {"./model.png: error: ", "would be lost"});
  check_refused(mistake("box.model --slice z=0 -o x.png --scene bx.yaml"),
                {"bx.yaml: error: ", "'box.yaml'"});
}

TEST_CASE("inspect: a model without bounds needs a scene") {
  const auto prepare = [](const ScratchFolder& f) {
    f.write("box.yaml", box_scene());
    f.write("train.yaml", training_config("stub_vertices"));
    REQUIRE(run_pharos("render train.yaml -q", f.path(), kStandIns).exit_code == 0);
  };
  check_refused({.arguments = "inspect box.model --slice z=0 -o x.png",
                 .prepare = prepare,
                 .environment = kStandIns},
                {"'stub_vertices'", "--scene"});
  const ScratchFolder folder;
  prepare(folder);
  CHECK(contains(inspect(folder, "box.model").out, "bounds   none\n"));
  picture(folder, "--slice z=0 --size 32 --scene box.yaml", "x.png");
}

TEST_CASE("inspect: shares of techniques, in numbers and in a picture") {
  const ScratchFolder folder;
  write_learned_model(folder);
  const Outcome outcome = inspect(folder, "box.model --scene box.yaml");
  REQUIRE(outcome.exit_code == 0);
  CHECK(contains(outcome.out, "mixing"));
  CHECK(contains(outcome.out, "bounce 2, roughness 0.25"));
  CHECK(contains(outcome.out, "unguided 0.500, stub_segments 0.500"));
  const Image shares =
      picture(folder, "--slice x=0 --shares --bounce 2 --size 64 --scene box.yaml", "shares.exr");
  CHECK(shares.width() == 60);
  CHECK(*shares.pixel(5, 10) == 0.5f);
  CHECK(std::isnan(*shares.pixel(29, 10)));
  CHECK(*shares.pixel(40, 10) == 0.5f);
  check_refused(mistake("box.model --shares"), {"--slice"});
  check_refused(mistake("box.model --slice x=0 --index 1 -o a.png"),
                {"--index 1: error: the file has 1 models"});
}

}  // namespace
}  // namespace pharos::testing
