#include "sample_report.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace pharos::test {
namespace {

const std::vector<std::string> kMethods{"path", "guided </script><b>", "guided & \"mixed\""};
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Interval around(double value, double relative) {
  return {value * (1 - relative), value * (1 + relative)};
}

ReportTable error_table(std::string key, std::string title, std::string unit, double scale) {
  ReportTable table{.key = std::move(key),
                    .title = std::move(title),
                    .unit = std::move(unit),
                    .definition =
                        "Mean over all pixels of the squared difference over the squared "
                        "reference, each squared error capped.",
                    .better = Better::lower,
                    .rows = {}};
  const auto cell = [&](double value, double ratio) {
    ReportCell result{value * scale, around(value * scale, 0.04), ratio, around(ratio, 0.055)};
    return result;
  };
  table.rows.push_back(
      {"still life", {cell(0.0125, 1), cell(0.00431, 0.345), cell(0.0052, 0.416)}});
  table.rows.push_back({"ramp", {cell(3.2e-5, 1), cell(kNaN, kNaN), cell(8.1e-6, 0.253)}});
  table.rows[1].cells[0].interval = Interval{0, kInfinity};
  table.rows[1].cells[1] = {};
  return table;
}

ReportTable speed_table() {
  return {.key = "rate",
          .title = "Samples a second",
          .unit = "1/s",
          .definition = "Samples of all pixels over the time of rendering.",
          .better = Better::higher,
          .rows = {{"still life", {{.value = 3.1e6}, {.value = 1.4e6}, {.value = 1.2e6}}},
                   {"ramp", {{.value = 5.5e6}, {.value = 5.5e6}, {.value = 5.1e6}}}}};
}

/// Returns errors that fall with the slope `slope`, with small irregularities.
ReportCurve curve(const std::string& scene, std::size_t method, const std::string& metric,
                  const std::string& axis, double start, double slope) {
  ReportCurve result{.scene = scene,
                     .method = kMethods[method],
                     .metric = metric,
                     .axis = axis,
                     .points = {},
                     .slope = slope,
                     .slope_interval = Interval{slope - 0.03, slope + 0.04}};
  for (int i = 0; i <= 8; ++i) {
    const double x = (axis == "samples" ? 4 : 0.35) * std::exp2(i);
    const double y = start * std::pow(std::exp2(i), slope) * (1 + 0.06 * std::sin(5 * i + method));
    result.points.push_back({x, y, around(y, 0.09 + 0.02 * static_cast<double>(method))});
  }
  return result;
}

/// Renders a sphere on a floor under a small light, with noise of the given strength.
Image still_life(double noise, unsigned seed) {
  constexpr int kWidth = 320, kHeight = 200;
  std::mt19937 numbers(seed);
  std::exponential_distribution<double> brightness(1);
  Image image(kWidth, kHeight, {"R", "G", "B"});
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double u = (x - 150) / 70.0, v = (y - 95) / 70.0, inside = 1 - u * u - v * v;
      const double light =
          inside > 0 ? std::max(0.02, -0.5 * u - 0.6 * v + 0.6 * std::sqrt(inside)) : 0;
      const double sparkle =
          inside > 0 ? 40 * std::pow(std::max(0.0, 1 - std::hypot(u + 0.4, v + 0.45)), 12) : 0;
      const double floor = y > 130
                               ? 0.35 * (1 - 0.8 * std::exp(-std::hypot(u - 0.5, 3 * (v - 0.9))))
                               : 0.12 + 0.001 * y;
      const double factor = 1 - noise + noise * brightness(numbers);
      const Rgb color = inside > 0 ? Rgb{0.9f, 0.35f, 0.12f} : Rgb{0.75f, 0.8f, 0.85f};
      const auto value = static_cast<float>(factor * (inside > 0 ? light : floor));
      const auto white = static_cast<float>(factor * sparkle);
      image.set_rgb(x, y,
                    {color.r * value + white, color.g * value + white, color.b * value + white});
    }
  }
  return image;
}

Image relative_error(const Image& image, const Image& reference) {
  Image map(image.width(), image.height(), {"Y"});
  for (std::size_t i = 0; i < map.values().size(); ++i) {
    const float truth = reference.values()[3 * i], error = image.values()[3 * i] - truth;
    map.values()[i] = error * error / (truth * truth + 0.01f);
  }
  return map;
}

ReportScene still_life_scene() {
  ReportScene scene{.name = "still life",
                    .note = "The reference is of 65,536 samples a pixel with another seed.",
                    .images = {},
                    .pictures = {}};
  const Image reference = still_life(0, 1);
  constexpr double kNoise[] = {0.7, 0.25, 0.35};
  for (std::size_t method = 0; method < kMethods.size(); ++method) {
    const Image image = still_life(kNoise[method], 2 + static_cast<unsigned>(method));
    scene.images.push_back(
        {kMethods[method], image, {{"relMSE", relative_error(image, reference)}}});
  }
  scene.images.push_back({"reference", reference, {}});
  for (const double width : {0.15, 0.4}) {
    Image density(160, 80, {"Y"});
    for (int i = 0; i < 160 * 80; ++i) {
      const double u = (i % 160 - 60) / 80.0, v = (i / 160 - 30) / 80.0;
      density.values()[i] =
          static_cast<float>(3e5 * std::exp(-(u * u + v * v) / (2 * width * width)));
    }
    scene.pictures.push_back(
        {"Learned density at the sphere's top, after 4 iterations <i>", density});
  }
  return scene;
}

Image ramp(float factor) {
  Image image(64, 32, {"R", "G", "B"});
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      image.set_rgb(x, y, {factor * (x + 1) / 64, factor * (y + 1) / 32, factor / 4});
    }
  }
  image.pixel(0, 0)[2] = 70000;
  image.pixel(1, 0)[2] = 0x1p-20f;
  return image;
}

ReportScene ramp_scene() {
  ReportScene scene{
      .name = "ramp", .note = "Values that a test knows.", .images = {}, .pictures = {}};
  for (std::size_t method = 0; method < kMethods.size(); ++method) {
    Image map(64, 32, {"Y"});
    for (int i = 0; i < 64 * 32; ++i) {
      map.values()[i] = std::ldexp(static_cast<float>(i % 64 + 1), -10 - static_cast<int>(method));
    }
    scene.images.push_back(
        {kMethods[method], ramp(1.25f + 0.25f * static_cast<float>(method)), {{"relMSE", map}}});
  }
  scene.images.back().image.pixel(5, 5)[0] = std::numeric_limits<float>::quiet_NaN();
  scene.images.push_back({"reference", ramp(1), {}});
  return scene;
}

}  // namespace

Report sample_report() {
  Report report{.title = "Guided & unguided: </script><script>alert(1)</script> \"été\" 測試\x01",
                .description =
                    "Three methods on two scenes at equal numbers of samples. Made up, to test "
                    "the page with: <img src=x onerror=alert(2)>",
                .facts = {{"Version", "0.1.0"},
                          {"Machine", "16 cores, 128 GiB"},
                          {"Budget", "1024 samples a pixel, 8 seeds"},
                          {"Reference", "65,536 samples a pixel"}},
                .methods = kMethods,
                .baseline = "path",
                .tables = {error_table("relative_mse", "relMSE", "", 1),
                           error_table("mse", "MSE", "radiance²", 0.31), speed_table()},
                .curves = {},
                .scenes = {still_life_scene(), ramp_scene()},
                .texts = {{"path.yaml",
                           "scene: ../scenes/still-life/scene.yaml\nsampler: sobol\n"
                           "integrator:\n  type: path # </script> & <b>\n"},
                          {"results.csv", "scene,method,relative_mse\nstill life,path,0.0125\n"}}};
  constexpr double kSlopes[] = {-0.98, -1.07, -0.71};
  for (const std::string scene : {"still life", "ramp"}) {
    for (const std::string metric : {"relative_mse", "mse"}) {
      for (const std::string axis : {"samples", "seconds"}) {
        for (std::size_t method = 0; method < kMethods.size(); ++method) {
          const double start =
              (scene == "ramp" ? 0.004 : 0.9) / (1.0 + 2.0 * static_cast<double>(method));
          report.curves.push_back(curve(scene, method, metric, axis, start, kSlopes[method]));
        }
      }
    }
  }
  report.curves[0].points[0].interval = Interval{0, kInfinity};
  report.curves[1].points[2].y = kNaN;
  return report;
}

}  // namespace pharos::test
