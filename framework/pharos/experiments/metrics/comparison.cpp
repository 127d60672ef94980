#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include <pharos/core/error.h>
#include <pharos/experiments/metrics/comparison.h>
#include <pharos/experiments/metrics/pixel_pair.h>

namespace pharos {
namespace {

constexpr const char* kReferenceLabel = "reference";

std::optional<double> number_in(const Metadata& metadata, const std::string& name) {
  const auto entry = metadata.find(name);
  if (entry == metadata.end()) return std::nullopt;
  char* end = nullptr;
  const double value = std::strtod(entry->second.c_str(), &end);
  if (end == entry->second.c_str()) return std::nullopt;
  return value;
}

ImageFile read(const std::filesystem::path& file, const std::string& label) {
  ImageFile result{file, label, rgb_only(read_image(file), file.string()), read_metadata(file)};
  std::erase_if(result.metadata,
                [](const auto& entry) { return !entry.first.starts_with("pharos:"); });
  return result;
}

/// Returns the names without folder and extension if they are all different, otherwise the whole
/// paths.
std::vector<std::string> labels_of(std::span<const std::filesystem::path> files) {
  const auto name_of = [](const std::filesystem::path& file) {
    return one_line(file.stem().string());
  };
  std::multiset<std::string> names{kReferenceLabel};
  for (const auto& file : files) names.insert(name_of(file));
  std::vector<std::string> labels;
  for (const auto& file : files) {
    const std::string name = name_of(file);
    labels.push_back(names.count(name) == 1 ? name : one_line(file.string()));
    if (std::count(labels.begin(), labels.end(), labels.back()) > 1) {
      throw InputError(fmt::format("{}: error: is named twice", file.string()));
    }
  }
  return labels;
}

/// Returns the exposure that the files state [stops]; see compare_files().
double stated_exposure(const Comparison& comparison) {
  std::optional<double> exposure = comparison.reference.exposure();
  for (const MeasuredImage& image : comparison.images) {
    if (!exposure) exposure = image.source.exposure();
  }
  return exposure.value_or(0);
}

}  // namespace

std::optional<double> ImageFile::samples() const {
  return number_in(metadata, "pharos:samples_per_pixel");
}

std::optional<double> ImageFile::seconds() const {
  std::optional<double> sum;
  for (const char* part : {"training", "update", "rendering"}) {
    const auto seconds = number_in(metadata, fmt::format("pharos:seconds_{}", part));
    if (seconds) sum = sum.value_or(0) + *seconds;
  }
  return sum;
}

std::optional<double> ImageFile::exposure() const {
  return number_in(metadata, "pharos:exposure");
}

bool Comparison::is_comparable(std::size_t i) const {
  std::size_t fewest = images[i].errors.invalid_pixels;
  for (const MeasuredImage& image : images) {
    fewest = std::min(fewest, image.errors.invalid_pixels);
  }
  return images[i].errors.invalid_pixels == fewest;
}

bool Comparison::is_best(std::size_t i, Metric metric) const {
  if (!is_comparable(i)) return false;
  const bool lower = metric_info(metric).lower_is_better;
  bool differ = false;
  for (std::size_t j = 0; j < images.size(); ++j) {
    if (!is_comparable(j)) continue;
    const double mine = images[i].errors[metric], theirs = images[j].errors[metric];
    if (lower ? theirs < mine : theirs > mine) return false;
    differ = differ || theirs != mine;
  }
  return differ;
}

std::optional<double> Comparison::ratio(std::size_t i, Metric metric) const {
  const double ratio = images[i].errors[metric] / images[0].errors[metric];
  if (i == 0 || !metric_info(metric).has_ratios || !std::isfinite(ratio)) return std::nullopt;
  if (!is_comparable(i) || !is_comparable(0)) return std::nullopt;
  return ratio;
}

Comparison compare_files(std::span<const std::filesystem::path> images,
                         const std::filesystem::path& reference, std::optional<double> exposure) {
  if (images.empty()) throw InputError("expected at least one image to compare");
  const std::vector<std::string> labels = labels_of(images);
  Comparison comparison{read(reference, kReferenceLabel), {}, {}};
  for (std::size_t i = 0; i < images.size(); ++i) {
    comparison.images.push_back({read(images[i], labels[i]), {}});
    pair_pixels(comparison.images[i].source.image, comparison.reference.image, images[i].string(),
                "'" + reference.string() + "'");
  }
  comparison.display.exposure =
      static_cast<float>(exposure ? *exposure : stated_exposure(comparison));
  // All files are valid. The measurements start here.
  for (MeasuredImage& image : comparison.images) {
    image.errors = measure(image.source.image, comparison.reference.image, comparison.display);
  }
  return comparison;
}

}  // namespace pharos
