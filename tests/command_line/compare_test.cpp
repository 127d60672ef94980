// Comparison of images from the command line: exit codes, messages, files.

#include <limits>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <pharos/core/image.h>

#include "refusal.h"

namespace pharos::testing {
namespace {

void write_constant(const ScratchFolder& folder, const std::string& name, float value,
                    int width = 20, int height = 10) {
  Image image(width, height, {"R", "G", "B"});
  for (float& v : image.values()) v = value;
  write_exr(image, folder.path() / name, {{"pharos:samples_per_pixel", "16"}});
}

/// Writes a reference of brightness 1, two images with relMSE 0.2475 and 0.0619, and one image with
/// a hole.
void write_images(const ScratchFolder& folder) {
  write_constant(folder, "ref.exr", 1);
  write_constant(folder, "far.exr", 1.5f);
  write_constant(folder, "near.exr", 1.25f);
  write_constant(folder, "wide.exr", 1, 21);
  Image hole(20, 10, {"R", "G", "B"});
  for (float& v : hole.values()) v = 1;
  hole.set_rgb(3, 3, Rgb(std::numeric_limits<float>::quiet_NaN()));
  write_exr(hole, folder.path() / "hole.exr");
}

Mistake mistake(const std::string& arguments) {
  return {.arguments = arguments, .prepare = write_images};
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_CASE("compare prints a table and writes nothing unasked") {
  const ScratchFolder folder;
  write_images(folder);
  const auto before = folder.listing();
  const Outcome outcome = run_pharos("compare far.exr near.exr --reference ref.exr", folder.path());
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err.empty());
  CHECK(contains(outcome.out, "reference ref.exr: 20 x 10 pixels, 16 samples a pixel\n"));
  CHECK(contains(outcome.out, "0.2475"));
  CHECK(contains(outcome.out, "0.06188* (0.25)"));
  CHECK(folder.listing() == before);
}

TEST_CASE("compare --json: a file beside the table, or standard output instead of it") {
  const ScratchFolder folder;
  write_images(folder);
  const Outcome file =
      run_pharos("compare far.exr --reference ref.exr --json out.json", folder.path());
  CHECK(file.exit_code == 0);
  CHECK(contains(file.out, "relMSE"));
  const Outcome standard =
      run_pharos("compare far.exr --reference ref.exr --json -", folder.path());
  CHECK(standard.exit_code == 0);
  CHECK(standard.out.front() == '{');
  CHECK(standard.out == test::bytes_of(folder.path() / "out.json"));
  CHECK(folder.file_count() == 6);  // nothing temporary is left
}

TEST_CASE("compare --error-images: a picture an image, by a metric of choice") {
  const ScratchFolder folder;
  write_images(folder);
  std::filesystem::create_directory(folder.path() / "errors");
  const Outcome outcome = run_pharos(
      "compare far.exr near.exr --reference ref.exr --error-images errors/", folder.path());
  CHECK(outcome.exit_code == 0);
  CHECK(contains(outcome.err, "relMSE from 2.48e-05 to 0.248, logarithmic"));
  CHECK(read_image(folder.path() / "errors/1-far-relative_mse.png").width() == 20);
  CHECK(folder.has("errors/2-near-relative_mse.png"));
  CHECK(run_pharos("compare far.exr --reference ref.exr --error-images e- --metric flip",
                   folder.path())
            .exit_code == 0);
  CHECK(folder.has("e-1-far-flip.png"));
}

TEST_CASE("compare --html: one page") {
  const ScratchFolder folder;
  write_images(folder);
  const Outcome outcome =
      run_pharos("compare far.exr near.exr --reference ref.exr --html page.html", folder.path());
  CHECK(outcome.exit_code == 0);
  CHECK(contains(outcome.out, "relMSE"));
  const std::string page = test::bytes_of(folder.path() / "page.html");
  for (const char* part : {"<html", "</html>", "far", "near", "relMSE", "HDR-FLIP"}) {
    CAPTURE(part);
    CHECK(contains(page, part));
  }
  CHECK(folder.file_count() == 6);  // nothing temporary is left
}

TEST_CASE("compare --max-relmse: 1 when an image is too far from the reference") {
  const ScratchFolder folder;
  write_images(folder);
  const auto run = [&](const std::string& arguments) {
    return run_pharos("compare --reference ref.exr " + arguments, folder.path());
  };
  CHECK(run("near.exr --max-relmse 0.1").exit_code == 0);
  CHECK(run("ref.exr --max-relmse 0").exit_code == 0);
  const Outcome far = run("near.exr far.exr --max-relmse 0.1 --json out.json");
  CHECK(far.exit_code == 1);
  CHECK(contains(far.err, "far.exr: failed: relMSE 0.247525, allowed 0.1\n"));
  CHECK_FALSE(contains(far.err, "near.exr"));
  CHECK(folder.has("out.json"));
}

TEST_CASE("compare: pixels without a value are told of, counted, and bad input") {
  const ScratchFolder folder;
  write_images(folder);
  const Outcome shown = run_pharos("compare hole.exr --reference ref.exr", folder.path());
  CHECK(shown.exit_code == 2);
  CHECK(contains(shown.err, "hole.exr: 1 of 200 pixels are NaN or infinite"));
  CHECK(contains(shown.out, "pixels left out  1\n"));
  const Outcome checked =
      run_pharos("compare hole.exr --reference ref.exr --max-relmse 1000", folder.path());
  CHECK(checked.exit_code == 1);
  CHECK(contains(checked.err, "no pixel may be left out"));
  // The same if the reference contains them.
  CHECK(run_pharos("compare ref.exr --reference hole.exr --max-relmse 1000", folder.path())
            .exit_code == 1);
}

TEST_CASE("compare: images that cannot be compared") {
  check_refused(mistake("compare wide.exr --reference ref.exr"),
                {"wide.exr", "'ref.exr'", "20 x 10", "21 x 10"});
  check_refused(mistake("compare fra.exr --reference ref.exr"), {"fra.exr", "'far.exr'"});
  check_refused(mistake("compare far.exr --reference rf.exr"), {"rf.exr", "'ref.exr'"});
  check_refused(mistake("compare far.exr far.exr --reference ref.exr"), {"far.exr", "named twice"});
  check_refused(mistake("compare . --reference ref.exr"), {"folder"});
  check_refused({.arguments = "compare text.exr --reference ref.exr",
                 .prepare =
                     [](const ScratchFolder& f) {
                       write_images(f);
                       f.write("text.exr", "not an image");
                     }},
                {"text.exr"});
  check_refused({.arguments = "compare gray.exr --reference ref.exr",
                 .prepare =
                     [](const ScratchFolder& f) {
                       write_images(f);
                       write_exr(Image(20, 10, {"Y"}), f.path() / "gray.exr");
                     }},
                {"gray.exr: error: ", "R, G and B", "'Y'"});
  check_refused({.arguments = "compare ref.exr nan.exr --reference ref.exr --json out.json",
                 .prepare =
                     [](const ScratchFolder& f) {
                       write_images(f);
                       write_constant(f, "nan.exr", std::numeric_limits<float>::quiet_NaN());
                     }},
                {"nan.exr: error: ", "no pixel is finite", "'ref.exr'"});
}

TEST_CASE("compare: wrong options") {
  check_refused(mistake("compare far.exr"), {"--reference"});
  check_refused(mistake("compare --reference ref.exr"), {"images"});
  check_refused(mistake("compare far.exr --reference ref.exr --metric flop"),
                {"--metric: error: ", "'flop'", "did you mean 'flip'?"});
  for (const char* limit : {"-1", "nan", "x"}) {
    check_refused(
        mistake(fmt::format("compare far.exr --reference ref.exr --max-relmse {}", limit)),
        {"--max-relmse"});
  }
}

TEST_CASE("compare: outputs that cannot be written are refused before the work") {
  check_refused(mistake("compare far.exr --reference ref.exr --json no/out.json"),
                {"no/out.json", "'no' does not exist"});
  check_refused(mistake("compare far.exr --reference ref.exr --html no/page.html"),
                {"no/page.html", "'no' does not exist"});
  check_refused(mistake("compare far.exr --reference ref.exr --html far.exr"), {"would be lost"});
  check_refused(mistake("compare far.exr --reference ref.exr --json ."), {"is a folder"});
  check_refused(mistake("compare far.exr --reference ref.exr --error-images no/"),
                {"'no' does not exist"});
  check_refused(mistake("compare near.exr --reference ref.exr --json ./ref.exr"),
                {"./ref.exr: error: ", "would be lost"});
  check_refused(mistake("compare near.exr far.exr --reference ref.exr --json far.exr"),
                {"far.exr: error: ", "would be lost"});
  // This mistake is reported before a missing image.
  check_refused(mistake("compare no.exr --reference ref.exr --json no/out.json"), {"no/out.json"});
}

TEST_CASE("compare: a render against itself") {
  const ScratchFolder folder;
  folder.write("box.yaml",
               fmt::format("scene: {}/cornell-box/scene.yaml\nfilm: {{ width: 20, height: 15 }}\n"
                           "budget: {{ spp: 4 }}\noutput: {{ png: false }}\n",
                           PHAROS_SCENES));
  REQUIRE(run_pharos("render box.yaml -q", folder.path()).exit_code == 0);
  REQUIRE(run_pharos("render box.yaml -q -o other.exr --set seed=2", folder.path()).exit_code == 0);
  const Outcome same =
      run_pharos("compare box.exr --reference box.exr --max-relmse 0", folder.path());
  CHECK(same.exit_code == 0);
  CHECK(contains(same.out, "samples a pixel  4\n"));
  CHECK(contains(same.out, "time [s]"));
  CHECK(
      run_pharos("compare other.exr --reference box.exr --max-relmse 0", folder.path()).exit_code ==
      1);
}

}  // namespace
}  // namespace pharos::testing
