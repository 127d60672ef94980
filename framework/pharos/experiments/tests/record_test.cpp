#include <limits>

#include <doctest/doctest.h>

#include <pharos/experiments/runner/run_record.h>

#include "../../tests/fixtures.h"

using namespace pharos;

namespace {

RunRecord full_record() {
  RunRecord record{.key = "k",
                   .version = "1.2.3",
                   .scene = "s",
                   .method = "m",
                   .seed = std::numeric_limits<std::uint64_t>::max(),
                   .samples_per_pixel = 0.1,
                   .times = {0.1, 0.2, 0.3, 1.0 / 3},
                   .rays = 5,
                   .invalid_paths = 6,
                   .gain = GuideGain{.nats = -0.5, .noise_ratio = 0.75, .is_off = true},
                   .model_bytes = 7,
                   .peak_bytes = 8.5,
                   .errors = {},
                   .checkpoints = {},
                   .files = {{".exr", "abc"}}};
  record.errors[Metric::mse] = 1.0 / 7;
  record.errors[Metric::psnr] = std::numeric_limits<double>::infinity();
  record.errors.invalid_pixels = 9;
  record.checkpoints.push_back({2, 0.5, record.errors});
  return record;
}

}  // namespace

TEST_CASE("records come back as they were, to the bit") {
  const test::TemporaryFolder folder;
  const RunRecord record = full_record();
  save_record(record, folder / "r.json");
  const auto loaded = load_record(folder / "r.json");
  REQUIRE(loaded);
  CHECK(loaded->key == record.key);
  CHECK(loaded->seed == record.seed);
  CHECK(loaded->times.rendering == record.times.rendering);
  CHECK(loaded->errors[Metric::mse] == record.errors[Metric::mse]);
  CHECK(loaded->errors[Metric::psnr] == record.errors[Metric::psnr]);
  CHECK(std::isnan(loaded->errors[Metric::flip]));
  CHECK(loaded->errors.invalid_pixels == 9);
  CHECK(loaded->checkpoints.at(0).errors[Metric::mse] == record.errors[Metric::mse]);
  CHECK(*loaded->peak_bytes == 8.5);
  CHECK(loaded->files == record.files);
  REQUIRE(loaded->gain);
  CHECK(loaded->gain->nats == -0.5);
  CHECK(loaded->gain->noise_ratio == std::optional(0.75));
  CHECK(loaded->gain->is_off);
}

TEST_CASE("no file and a file of another format are no records") {
  const test::TemporaryFolder folder;
  CHECK_FALSE(load_record(folder / "none.json"));
  CHECK_FALSE(load_record(folder.write("other.json", "{\"format\": 99}")));
}

TEST_CASE("records that are cut off or changed are input errors") {
  const test::TemporaryFolder folder;
  const auto refusal = [&](const std::string& text) {
    const auto path = folder.write("record.json", text);
    return test::input_error_in(folder, [&] { load_record(path); });
  };
  const std::string damaged = "record.json: error: the record is damaged or was changed";
  CHECK(refusal("{\"format\": 5, \"key\": \"") == damaged);
  CHECK(refusal("[1, 2]") == damaged);
  CHECK(refusal("{\"format\": 5, \"key\": 3}") == damaged);
  save_record(full_record(), folder / "record.json");
  std::string text = test::bytes_of(folder / "record.json");
  CHECK(refusal(text) == "no error");
  text.replace(text.find("\"seed\": "), 9, "\"seed\": 2");
  CHECK(refusal(text) == damaged);
  std::filesystem::remove(folder / "record.json");
  std::filesystem::create_directory(folder / "record.json");
  CHECK(test::input_error_in(folder, [&] { load_record(folder / "record.json"); }) ==
        "record.json: error: expected a file, found a folder");
}
