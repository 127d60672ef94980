#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <pharos/core/atomic_file.h>
#include <pharos/core/error.h>
#include <pharos/core/log.h>
#include <pharos/core/threads.h>
#include <pharos/core/writable.h>
#include <pharos/experiments/metrics/comparison.h>
#include <pharos/experiments/pictures/error_images.h>

#include "commands.h"

namespace pharos {
namespace {

/// The file name that means standard output.
constexpr const char* kStandardOutput = "-";

struct CompareOptions {
  std::vector<std::filesystem::path> images;
  std::filesystem::path reference;
  std::string json;
  std::string html;
  std::string error_images;
  std::string metric = "relative_mse";
  std::optional<double> exposure, max_relmse;
  int threads = 0;
};

Metric metric_named(const std::string& name) {
  std::vector<std::string> keys;
  for (const MetricInfo& info : metric_infos()) {
    if (info.key == name) return info.metric;
    keys.emplace_back(info.key);
  }
  throw InputError(fmt::format("--metric: error: expected one of {}, found '{}'{}",
                               quoted_list(keys), name, suggestion(name, keys)));
}

/// Refuses a file that cannot be written, and an input file that would be overwritten.
void check_output(const std::filesystem::path& file, const CompareOptions& options) {
  check_writable(file);
  const auto is_read = [&](const std::filesystem::path& input) {
    std::error_code ignored;
    return std::filesystem::equivalent(file, input, ignored);
  };
  if (is_read(options.reference) || std::ranges::any_of(options.images, is_read)) {
    throw InputError(fmt::format("{}: error: is one of the images to compare, and would be lost",
                                 file.string()));
  }
}

/// Fails before the work starts if its results could not be written.
void check_options(const CompareOptions& options) {
  if (options.max_relmse && !(*options.max_relmse >= 0)) {
    throw InputError(fmt::format("--max-relmse: error: expected a number of 0 or more, found {}",
                                 *options.max_relmse));
  }
  const Metric metric = metric_named(options.metric);
  if (options.json != kStandardOutput) check_output(options.json, options);
  if (options.html == kStandardOutput) {
    throw InputError("--html: error: expected the name of a file, found '-'");
  }
  if (!options.html.empty() && options.html == options.json) {
    throw InputError("--html: error: expected another file than --json's");
  }
  check_output(options.html, options);
  if (options.error_images.empty()) return;
  for (std::size_t i = 0; i < options.images.size(); ++i) {
    check_output(error_image_file(options.error_images, i + 1, options.images[i], metric), options);
  }
}

/// Whether an image has pixels without a value. Warns of each such image.
bool has_invalid_pixels(const Comparison& comparison) {
  bool found = false;
  for (const MeasuredImage& image : comparison.images) {
    if (image.errors.invalid_pixels == 0) continue;
    found = true;
    log_warning(fmt::format(
        "{}: {} of {} pixels are NaN or infinite, here or in the reference, and are "
        "left out of every metric",
        image.source.file.string(), image.errors.invalid_pixels,
        static_cast<std::size_t>(image.source.image.width()) * image.source.image.height()));
  }
  return found;
}

void write_outputs(const Comparison& comparison, const CompareOptions& options) {
  if (options.json == kStandardOutput) {
    fmt::print("{}", comparison_json(comparison));
  } else {
    fmt::print("{}", comparison_table(comparison));
    if (!options.json.empty()) write_text_atomically(options.json, comparison_json(comparison));
  }
  if (!options.html.empty()) write_report(comparison_report(comparison), options.html);
  if (options.error_images.empty()) return;
  const Metric metric = metric_named(options.metric);
  const ColorScale scale = write_error_images(comparison, metric, options.error_images);
  log_info(fmt::format("{}*-{}.png: {} from {:.3g} to {:.3g}{}", options.error_images,
                       options.metric, metric_info(metric).title, scale.low, scale.high,
                       scale.logarithmic ? ", logarithmic" : ""));
}

/// Whether an image is too far from the reference. An image with pixels that were left out counts
/// as too far, because nothing is known of these pixels.
bool too_different(const Comparison& comparison, double max_relmse) {
  bool found = false;
  for (const MeasuredImage& image : comparison.images) {
    const double relmse = image.errors[Metric::relative_mse];
    if (relmse <= max_relmse && image.errors.invalid_pixels == 0) continue;
    found = true;
    log_warning(fmt::format(
        "{}: failed: relMSE {:.6g}, allowed {:.6g}{}", image.source.file.string(), relmse,
        max_relmse, image.errors.invalid_pixels > 0 ? ", but no pixel may be left out" : ""));
  }
  return found;
}

int compare(const CompareOptions& options) {
  check_options(options);
  const Comparison comparison = compare_files(options.images, options.reference, options.exposure);
  const bool is_bad = has_invalid_pixels(comparison);
  write_outputs(comparison, options);
  if (options.max_relmse && too_different(comparison, *options.max_relmse)) return kTooDifferent;
  // The results for the other pixels have been reported, but the input is still wrong.
  return is_bad ? kBadInput : kDone;
}

}  // namespace

void add_compare_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("compare", "Measure images against a reference");
  const auto options = std::make_shared<CompareOptions>();
  command->add_option("images", options->images, "Images; ratios are to the first")->required();
  command->add_option("--reference", options->reference, "The image that is taken for the truth")
      ->required();
  command->add_option("--json", options->json,
                      "Write all numbers to this file; '-': to standard output, without the table");
  command->add_option("--html", options->html, "Write a page with images, error maps and tables");
  command->add_option("--error-images", options->error_images,
                      "Write PNGs of each pixel's error whose names begin with this, such as "
                      "errors/ for a folder");
  command->add_option("--metric", options->metric, "Metric of the error images")
      ->capture_default_str();
  command->add_option("--exposure", options->exposure,
                      "Exposure of the images for PSNR and FLIP [stops] instead of the one that "
                      "the reference or an image states");
  command->add_option(
      "--max-relmse", options->max_relmse,
      "Exit with 1 when an image's relMSE is larger, or has pixels without a value");
  command->add_option("--threads", options->threads, "Number of threads; 0: all cores")
      ->check(CLI::Range(0, 1024));
  command->callback([options, &exit_code] {
    with_threads(options->threads, [&] { exit_code = compare(*options); });
  });
}

}  // namespace pharos
