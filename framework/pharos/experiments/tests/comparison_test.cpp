#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <pharos/core/error.h>
#include <pharos/experiments/metrics/comparison.h>
#include <pharos/experiments/pictures/error_images.h>

#include "../../tests/fixtures.h"
#include "test_images.h"

namespace pharos {
namespace {

namespace fs = std::filesystem;
using test::constant;

/// A folder with images of constant brightness 1 (the reference), 1.5, 1.25 and 1 again.
class Folder {
 public:
  Folder() {
    fs::create_directories(files_ / "old");
    write("ref.exr", 1, {{"pharos:samples_per_pixel", "4096"}});
    write("far.exr", 1.5f, {{"other:program", "x"}});
    write("near.exr", 1.25f,
          {{"pharos:samples_per_pixel", "64"},
           {"pharos:seconds_preparation", "9"},
           {"pharos:seconds_training", "1.5"},
           {"pharos:seconds_update", "0.25"},
           {"pharos:seconds_rendering", "2"},
           {"pharos:config", "seed: 7\n"}});
    write("old/near.exr", 1);
  }

  fs::path operator/(const std::string& name) const { return files_ / name; }
  void write(const std::string& name, float value, const Metadata& metadata = {}) const {
    write_exr(constant(8, 6, Rgb(value)), files_ / name, metadata);
  }
  Comparison compare(const std::vector<std::string>& names,
                     std::optional<double> exposure = {}) const {
    std::vector<fs::path> files;
    for (const std::string& name : names) files.push_back(files_ / name);
    return compare_files(files, files_ / "ref.exr", exposure);
  }
  std::string refusal(const std::vector<std::string>& names) const {
    try {
      compare(names);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

 private:
  test::TemporaryFolder files_;
};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Returns the line of `text` that begins with `start`, with single spaces.
std::string line_of(const std::string& text, const std::string& start) {
  const std::size_t at = text.find("\n" + start) + 1;
  std::string line;
  for (const char c : text.substr(at, text.find('\n', at) - at)) {
    if (c != ' ' || (!line.empty() && line.back() != ' ')) line += c;
  }
  return line;
}

}  // namespace

TEST_CASE("comparison: values, the best, ratios") {
  const Folder folder;
  const Comparison c = folder.compare({"far.exr", "near.exr"});
  REQUIRE(c.images.size() == 2);
  CHECK(c.reference.label == "reference");
  CHECK(c.images[0].source.label == "far");
  CHECK(c.images[0].errors[Metric::mse] == 0.25);
  CHECK(c.images[1].errors[Metric::mse] == 0.0625);
  CHECK_FALSE(c.is_best(0, Metric::mse));
  CHECK(c.is_best(1, Metric::mse));
  CHECK_FALSE(c.is_best(1, Metric::psnr));  // both are clipped to white, so they are equal
  CHECK_FALSE(c.ratio(0, Metric::mse));
  CHECK(*c.ratio(1, Metric::mse) == 0.25);
  CHECK_FALSE(c.ratio(1, Metric::psnr));
  CHECK_FALSE(c.ratio(1, Metric::flip));  // 0 / 0, because both are clipped to white
}

TEST_CASE("comparison: for PSNR more is better") {
  const Folder folder;
  folder.write("dark.exr", 0.25f);
  folder.write("darker.exr", 0.125f);
  const Comparison c = folder.compare({"darker.exr", "dark.exr"});
  CHECK(c.is_best(1, Metric::psnr));
  CHECK_FALSE(c.is_best(0, Metric::psnr));
}

TEST_CASE("comparison: what Pharos wrote into images") {
  const Folder folder;
  const Comparison c = folder.compare({"far.exr", "near.exr"});
  CHECK(*c.reference.samples() == 4096);
  CHECK_FALSE(c.reference.seconds());
  CHECK(c.images[0].source.metadata.empty());
  CHECK_FALSE(c.images[0].source.samples());
  CHECK(*c.images[1].source.samples() == 64);
  CHECK(*c.images[1].source.seconds() == 3.75);
}

TEST_CASE("comparison: labels tell images apart") {
  const Folder folder;
  const Comparison c = folder.compare({"near.exr", "old/near.exr", "far.exr"});
  CHECK(c.images[0].source.label == (folder / "near.exr").string());
  CHECK(c.images[1].source.label == (folder / "old/near.exr").string());
  CHECK(c.images[2].source.label == "far");
  folder.write("reference.exr", 2);
  CHECK(folder.compare({"reference.exr"}).images[0].source.label != "reference");
  CHECK(folder.refusal({"near.exr", "far.exr", "near.exr"}) ==
        (folder / "near.exr").string() + ": error: is named twice");
}

TEST_CASE("comparison: images that cannot be compared") {
  const Folder folder;
  write_exr(constant(9, 6, Rgb(1)), folder / "wide.exr");
  write_exr(Image(8, 6, {"Y"}), folder / "gray.exr");
  folder.write("nan.exr", std::numeric_limits<float>::quiet_NaN());
  const std::string reference = "'" + (folder / "ref.exr").string() + "'";
  CHECK(folder.refusal({"wide.exr"}) == (folder / "wide.exr").string() +
                                            ": error: expected the size of " + reference +
                                            ", 8 x 6 pixels, found 9 x 6");
  CHECK(folder.refusal({"gray.exr"}) ==
        (folder / "gray.exr").string() + ": error: expected channels R, G and B, found 'Y'");
  CHECK(folder.refusal({"far.exr", "nan.exr"}) ==
        (folder / "nan.exr").string() + ": error: no pixel is finite both here and in " +
            reference);
  CHECK(contains(folder.refusal({"fra.exr"}), "fra.exr"));
  CHECK(contains(folder.refusal({"fra.exr"}), "did you mean"));
  CHECK(folder.refusal({}) != "");
}

TEST_CASE("table: one image") {
  const Folder folder;
  const std::string text = comparison_table(folder.compare({"far.exr"}));
  CHECK(contains(text, "ref.exr: 8 x 6 pixels, 4096 samples a pixel\n"));
  CHECK(line_of(text, "MSE") == "MSE 0.25");
  CHECK(line_of(text, "PSNR") == "PSNR [dB] inf");
  CHECK_FALSE(contains(text, "*"));
  CHECK_FALSE(contains(text, "time"));
  CHECK_FALSE(contains(text, "left out"));
}

TEST_CASE("table: several images") {
  const Folder folder;
  Image holes = constant(8, 6, Rgb(1.5f));
  holes.set_rgb(1, 1, Rgb(std::numeric_limits<float>::quiet_NaN()));
  write_exr(holes, folder / "holes.exr");
  const std::string text = comparison_table(folder.compare({"far.exr", "near.exr", "holes.exr"}));
  CHECK(line_of(text, "MSE") == "MSE 0.25 0.0625* (0.25) 0.25");
  CHECK(line_of(text, "samples") == "samples a pixel - 64 -");
  CHECK(line_of(text, "time") == "time [s] - 3.75 -");
  CHECK(line_of(text, "pixels left out") == "pixels left out - - 1");
  CHECK(contains(text, "over 'far'"));
  // Columns begin at the same position in every row.
  const auto column = [&](const std::string& row, const std::string& cell) {
    const std::size_t start = text.find("\n" + row);
    return text.find(cell, start) - start;
  };
  CHECK(column("MSE", "0.0625") == column("samples", "64"));
  CHECK(column("MSE", "0.0625") == column("time", "3.75"));
}

TEST_CASE("comparison: the exposure is given, or stated by the reference or an image") {
  const Folder folder;
  CHECK(folder.compare({"far.exr"}).display.exposure == 0);
  CHECK_FALSE(contains(comparison_table(folder.compare({"far.exr"})), "exposure"));
  folder.write("exposed.exr", 1.5f, {{"pharos:exposure", "-2"}});
  const Comparison by_image = folder.compare({"near.exr", "exposed.exr"});
  CHECK(by_image.display.exposure == -2);
  CHECK(contains(comparison_table(by_image), "exposure for PSNR and FLIP: -2 stops\n"));
  // A quarter of the brightness is below white, so PSNR sees the difference.
  CHECK(by_image.images[0].errors[Metric::psnr] == doctest::Approx(-20 * std::log10(0.25 / 4)));
  folder.write("ref.exr", 1, {{"pharos:exposure", "-3"}});
  const Comparison by_reference = folder.compare({"near.exr", "exposed.exr"});
  CHECK(by_reference.display.exposure == -3);
  CHECK(nlohmann::json::parse(comparison_json(by_reference))["exposure"] == -3);
  CHECK(folder.compare({"exposed.exr"}, 1.5).display.exposure == 1.5f);
}

TEST_CASE("JSON: everything, with infinity as a word") {
  const Folder folder;
  const auto json = nlohmann::json::parse(comparison_json(folder.compare({"far.exr", "near.exr"})));
  CHECK(json["width"] == 8);
  CHECK(json["height"] == 6);
  CHECK(json["reference"]["metadata"]["pharos:samples_per_pixel"] == "4096");
  REQUIRE(json["metrics"].size() == kMetricCount);
  CHECK(json["metrics"][2]["key"] == "relative_mse");
  CHECK(json["metrics"][7]["lower_is_better"] == false);
  const auto& near = json["images"][1];
  CHECK(near["label"] == "near");
  CHECK(near["errors"].size() == kMetricCount);
  CHECK(near["errors"]["mse"] == 0.0625);
  CHECK(near["errors"]["psnr"] == "Infinity");
  CHECK(near["ratios"]["mse"] == 0.25);
  CHECK_FALSE(near["ratios"].contains("psnr"));
  CHECK(json["images"][0]["ratios"].empty());
  CHECK(near["invalid_pixels"] == 0);
  CHECK(near["metadata"]["pharos:config"] == "seed: 7\n");
}

TEST_CASE("JSON: file names that are not UTF-8") {
  const Folder folder;
  folder.write("\xff.exr", 2);
  const std::string json = comparison_json(folder.compare({"\xff.exr"}));
  CHECK_FALSE(nlohmann::json::parse(json, nullptr, false).is_discarded());
}

TEST_CASE("report: tables, images, maps and texts") {
  const Folder folder;
  const Report report = comparison_report(folder.compare({"far.exr", "near.exr"}));
  CHECK(report.methods == std::vector<std::string>{"far", "near"});
  CHECK(report.baseline == "far");
  REQUIRE(report.tables.size() == kMetricCount);
  const ReportTable& mse = report.tables[0];
  CHECK(mse.key == "mse");
  CHECK(mse.better == Better::lower);
  REQUIRE(mse.rows.size() == 1);
  REQUIRE(mse.rows[0].cells.size() == 2);
  CHECK(mse.rows[0].cells[1].value == 0.0625);
  CHECK(*mse.rows[0].cells[1].ratio == 0.25);
  CHECK_FALSE(mse.rows[0].cells[0].ratio);
  CHECK(report.tables[7].better == Better::higher);
  REQUIRE(report.scenes.size() == 1);
  CHECK(report.scenes[0].name == mse.rows[0].scene);
  const auto& images = report.scenes[0].images;
  REQUIRE(images.size() == 3);
  CHECK(images[0].label == "reference");
  CHECK(images[0].error_maps.empty());
  CHECK(images[2].label == "near");
  CHECK(images[2].image.rgb(0, 0) == Rgb(1.25f));
  REQUIRE(images[2].error_maps.size() == 3);
  CHECK(images[2].error_maps[0].metric == "relMSE");
  CHECK(images[2].error_maps[0].map.values()[0] == doctest::Approx(0.0625 / 1.01));
  REQUIRE(report.texts.size() == 2);
  CHECK(report.texts[0].text == "seed: 7\n");
  CHECK(comparison_report(folder.compare({"far.exr"})).baseline == "");
}

TEST_CASE("error images: the scale covers all maps") {
  Image dark(50, 20, {"Y"}), bright(50, 20, {"Y"});
  for (float& v : dark.values()) v = 0.5f;
  for (float& v : bright.values()) v = 2;
  bright.values()[0] = 1e9f;  // one pixel in two thousand is above the scale
  bright.values()[1] = std::numeric_limits<float>::quiet_NaN();
  const ColorScale scale = error_scale(Metric::relative_mse, std::vector{dark, bright});
  CHECK(scale.logarithmic);
  CHECK(scale.high == 2);
  CHECK(scale.low == doctest::Approx(2e-4));
  const ColorScale flip = error_scale(Metric::flip, std::vector{dark, bright});
  CHECK_FALSE(flip.logarithmic);
  CHECK(flip.low == 0);
  CHECK(flip.high == 1);
  CHECK(error_scale(Metric::mse, std::vector{Image(3, 3, {"Y"})}).high == 1);
}

TEST_CASE("error images: a picture an image") {
  const Folder folder;
  write_error_images(folder.compare({"near.exr", "old/near.exr"}), Metric::relative_mse,
                     (folder / "errors-").string());
  const Image wrong = read_image(folder / "errors-1-near-relative_mse.png");
  const Image right = read_image(folder / "errors-2-near-relative_mse.png");
  CHECK(wrong.width() == 8);
  CHECK(std::abs(wrong.rgb(2, 2).r - magma(1).r) < 0.01);
  CHECK(std::abs(right.rgb(2, 2).r - magma(0).r) < 0.01);
}

}  // namespace pharos
