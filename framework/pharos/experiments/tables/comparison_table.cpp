#include <functional>

#include <fmt/format.h>

#include <pharos/experiments/metrics/comparison.h>
#include <pharos/experiments/tables/text_table.h>

namespace pharos {
namespace {

std::string cell(const Comparison& comparison, std::size_t i, Metric metric) {
  std::string text = fmt::format("{:.4g}", comparison.images[i].errors[metric]);
  if (comparison.is_best(i, metric)) text += "*";
  if (const auto ratio = comparison.ratio(i, metric)) text += fmt::format(" ({:.3g})", *ratio);
  return text;
}

std::string or_dash(const std::optional<double>& value) {
  return value ? fmt::format("{:.4g}", *value) : "-";
}

/// Adds a row with one fact about each image. The row is left out if no image has a value.
void add_fact(std::vector<TextRow>& rows, const Comparison& comparison, const std::string& title,
              const std::function<std::optional<double>(const MeasuredImage&)>& fact) {
  TextRow row{title};
  bool known = false;
  for (const MeasuredImage& image : comparison.images) {
    const auto value = fact(image);
    row.push_back(or_dash(value));
    known = known || value;
  }
  if (known) rows.push_back(row);
}

std::string reference_line(const ImageFile& reference) {
  std::string line = fmt::format("reference {}: {} x {} pixels", reference.file.string(),
                                 reference.image.width(), reference.image.height());
  if (reference.samples()) line += fmt::format(", {:.4g} samples a pixel", *reference.samples());
  if (reference.seconds()) line += fmt::format(", {:.4g} s", *reference.seconds());
  return line + '\n';
}

std::string exposure_line(const Comparison& comparison) {
  if (comparison.display.exposure == 0) return "";
  return fmt::format("exposure for PSNR and FLIP: {:g} stops\n", comparison.display.exposure);
}

}  // namespace

std::string comparison_table(const Comparison& comparison) {
  std::vector<TextRow> rows{{""}};
  for (const MeasuredImage& image : comparison.images) rows[0].push_back(image.source.label);
  for (const MetricInfo& info : metric_infos()) {
    TextRow row{info.unit.empty() ? std::string(info.title)
                                  : fmt::format("{} [{}]", info.title, info.unit)};
    for (std::size_t i = 0; i < comparison.images.size(); ++i) {
      row.push_back(cell(comparison, i, info.metric));
    }
    rows.push_back(row);
  }
  add_fact(rows, comparison, "samples a pixel",
           [](const MeasuredImage& image) { return image.source.samples(); });
  add_fact(rows, comparison, "time [s]",
           [](const MeasuredImage& image) { return image.source.seconds(); });
  add_fact(rows, comparison, "pixels left out", [](const MeasuredImage& image) {
    const auto count = static_cast<double>(image.errors.invalid_pixels);
    return count > 0 ? std::optional(count) : std::nullopt;
  });
  std::string text =
      reference_line(comparison.reference) + exposure_line(comparison) + '\n' + aligned(rows);
  if (comparison.images.size() > 1) {
    text += fmt::format("\n* the best of its row; in brackets: over '{}'\n",
                        comparison.images[0].source.label);
  }
  return text;
}

}  // namespace pharos
