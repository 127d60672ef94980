#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <pharos/experiments/pictures/error_images.h>

namespace pharos {
namespace {

constexpr double kDecades = 1e4;
constexpr std::size_t kPixelsPerBrightest = 1000;

}  // namespace

std::filesystem::path error_image_file(const std::string& prefix, std::size_t index,
                                       const std::filesystem::path& file, Metric metric) {
  return fmt::format("{}{}-{}-{}.png", prefix, index, file.stem().string(),
                     metric_info(metric).key);
}

ColorScale error_scale(Metric metric, std::span<const Image> maps) {
  if (metric == Metric::flip || metric == Metric::hdr_flip) return {.low = 0, .high = 1};
  std::vector<float> values;
  for (const Image& map : maps) {
    std::ranges::copy_if(map.values(), std::back_inserter(values),
                         [](float v) { return std::isfinite(v); });
  }
  if (values.empty()) return {};
  const auto top =
      values.end() - 1 - static_cast<std::ptrdiff_t>(values.size() / kPixelsPerBrightest);
  std::nth_element(values.begin(), top, values.end());
  if (!(*top > 0)) return {};
  return {.low = *top / kDecades, .high = *top, .logarithmic = true};
}

ColorScale write_error_images(const Comparison& comparison, Metric metric,
                              const std::string& prefix) {
  std::vector<Image> maps;
  for (const MeasuredImage& image : comparison.images) {
    maps.push_back(
        error_map(metric, image.source.image, comparison.reference.image, comparison.display));
  }
  const ColorScale scale = error_scale(metric, maps);
  for (std::size_t i = 0; i < maps.size(); ++i) {
    write_png(false_color(maps[i], scale),
              error_image_file(prefix, i + 1, comparison.images[i].source.file, metric), 0, false);
  }
  return scale;
}

}  // namespace pharos
