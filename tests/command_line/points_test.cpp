// Pictures of the points of samplers from the command line, and mistakes.

#include <algorithm>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <pharos/core/image.h>

#include "refusal.h"

namespace pharos::testing {
namespace {

constexpr const char* kSmall = "--size 40 --frequency 3 --realizations 2 -n 16";

/// A picture and the message of the program about it.
struct Drawn {
  Image image;
  std::string message;
};

/// Returns the result of `points ARGUMENTS -o points.png`.
Drawn drawn(const std::string& arguments, const std::string& says) {
  const ScratchFolder folder;
  const Outcome outcome =
      run_pharos(fmt::format("points {} {} -o points.png", arguments, kSmall), folder.path());
  CAPTURE(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK(outcome.err.find("points.png: " + says) != std::string::npos);
  CHECK(folder.file_count() == 1);
  return {read_image(folder.path() / "points.png"), outcome.err};
}

Image picture(const std::string& arguments, const std::string& says = "") {
  return drawn(arguments, says).image;
}

/// Returns the number of samplers that a message names: `points.png: a, b, c; …`.
int count_of_samplers(const std::string& message) {
  return 1 + static_cast<int>(std::count(
                 message.begin(), message.begin() + static_cast<long>(message.find(';')), ','));
}

Mistake mistake(const std::string& arguments) {
  return {.arguments = fmt::format("points {}", arguments)};
}

}  // namespace

TEST_CASE("points: one sampler beside its spectrum, several as columns") {
  const Image one = picture("--sampler sobol", "sobol; 16 points");
  CHECK(one.height() == 40);
  CHECK(one.width() > 80);
  const Image two =
      picture("--sampler independent --sampler '{ type: sobol }'", "independent, { type: sobol };");
  CHECK(two.width() == one.width());
  CHECK(two.height() > 80);
  // Five columns side by side, with two squares each. The gaps are the same as in the picture of
  // two columns.
  const Drawn all = drawn("", "");
  const int gap = two.height() - 2 * 40, rows = 2 * ((count_of_samplers(all.message) + 4) / 5);
  CHECK(count_of_samplers(all.message) >= 10);
  CHECK(all.image.height() == rows * 40 + (rows - 1) * gap);
  CHECK(all.image.width() == 5 * 40 + 4 * gap);
}

TEST_CASE("points: the picture is that of the seed and the dimension") {
  const Image first = picture("--sampler sobol");
  CHECK(picture("--sampler sobol").values() == first.values());
  CHECK(picture("--sampler sobol --seed 2").values() != first.values());
  CHECK(picture("--sampler sobol --dimension lens").values() != first.values());
}

TEST_CASE("points: mistakes") {
  check_refused(mistake("--sampler sobl -o x.png"), {"'sobl'", "did you mean 'sobol'?"});
  check_refused(mistake("--sampler '{ type: sobol, n: 3 }' -o x.png"), {"--sampler", "'n'"});
  check_refused(mistake("--dimension lense -o x.png"),
                {"--dimension lense: error: ", "did you mean 'lens'?"});
  check_refused(mistake("--dimension roulette -o x.png"), {"--dimension roulette: error: "});
  check_refused(mistake("--sampler sobol"), {"--output"});
  check_refused(mistake("-o x.exr"), {"x.exr: error: ", ".png"});
  check_refused(mistake("-o none/x.png"), {"'none' does not exist"});
  check_refused(mistake("-n 0 -o x.png"), {"0"});
  check_refused(mistake("--frequency 0 -o x.png"), {"--frequency"});
}

}  // namespace pharos::testing
