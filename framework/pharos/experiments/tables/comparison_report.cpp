#include <array>

#include <fmt/format.h>

#include <pharos/core/version.h>
#include <pharos/experiments/metrics/comparison.h>

namespace pharos {
namespace {

/// The name of the only row of every table.
constexpr const char* kScene = "comparison";
/// The error maps of each image.
constexpr std::array kMaps{Metric::relative_mse, Metric::flip, Metric::hdr_flip};

std::string file_fact(const ImageFile& image) {
  std::string text = image.file.string();
  if (image.samples()) text += fmt::format(", {:.4g} samples a pixel", *image.samples());
  if (image.seconds()) text += fmt::format(", {:.4g} s", *image.seconds());
  return text;
}

ReportTable table_of(const Comparison& comparison, const MetricInfo& info) {
  ReportTable table{.key = std::string(info.key),
                    .title = std::string(info.title),
                    .unit = std::string(info.unit),
                    .definition = fmt::format("{} ({}).", info.definition, info.source),
                    .better = info.lower_is_better ? Better::lower : Better::higher,
                    .rows = {{kScene, {}}}};
  for (std::size_t i = 0; i < comparison.images.size(); ++i) {
    table.rows[0].cells.push_back({.value = comparison.images[i].errors[info.metric],
                                   .interval = {},
                                   .ratio = comparison.ratio(i, info.metric),
                                   .ratio_interval = {},
                                   .contends = comparison.is_comparable(i)});
  }
  return table;
}

ReportScene scene_of(const Comparison& comparison) {
  ReportScene scene{.name = kScene,
                    .note = "Reference: " + comparison.reference.file.string(),
                    .images = {},
                    .pictures = {}};
  scene.images.push_back({comparison.reference.label, comparison.reference.image, {}});
  for (const MeasuredImage& image : comparison.images) {
    ReportImage shown{image.source.label, image.source.image, {}};
    for (const Metric metric : kMaps) {
      shown.error_maps.push_back(
          {std::string(metric_info(metric).title),
           error_map(metric, image.source.image, comparison.reference.image, comparison.display)});
    }
    scene.images.push_back(std::move(shown));
  }
  return scene;
}

void add_config(Report& report, const ImageFile& image) {
  const auto config = image.metadata.find("pharos:config");
  if (config == image.metadata.end()) return;
  report.texts.push_back({"Config of " + image.label, config->second});
}

}  // namespace

Report comparison_report(const Comparison& comparison) {
  const Image& reference = comparison.reference.image;
  Report report;
  report.title = "Comparison with " + comparison.reference.file.filename().string();
  report.description = "Error of images against a reference.";
  report.facts = {
      {"Pharos", version()},
      {"Size", fmt::format("{} x {} pixels", reference.width(), reference.height())},
      {"Reference", file_fact(comparison.reference)},
      {"Exposure for PSNR and FLIP", fmt::format("{:.4g} stops", comparison.display.exposure)}};
  for (const MeasuredImage& image : comparison.images) {
    std::string fact = file_fact(image.source);
    if (const std::size_t count = image.errors.invalid_pixels; count > 0) {
      fact += fmt::format(", {} pixels left out, as they are not finite", count);
    }
    report.facts.emplace_back(image.source.label, fact);
    report.methods.push_back(image.source.label);
  }
  if (report.methods.size() > 1) report.baseline = report.methods[0];
  for (const MetricInfo& info : metric_infos()) report.tables.push_back(table_of(comparison, info));
  report.scenes.push_back(scene_of(comparison));
  add_config(report, comparison.reference);
  for (const MeasuredImage& image : comparison.images) add_config(report, image.source);
  report.texts.push_back({"Numbers as JSON", comparison_json(comparison)});
  return report;
}

}  // namespace pharos
