#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <pharos/core/image.h>
#include <pharos/experiments/metrics/metrics.h>
#include <pharos/experiments/report/report.h>

/// Comparison of image files with a reference. Errors are measured once and written as text, as
/// JSON and as a report page.
namespace pharos {

/// An image file with the metadata that Pharos wrote into it.
struct ImageFile {
  std::filesystem::path file;
  std::string label;  ///< short and unique within a comparison; "reference" for the reference
  Image image;        ///< R, G, B
  Metadata metadata;  ///< entries named "pharos:…"; empty for images of other programs

  /// Returns the samples per pixel; empty if the metadata does not state them.
  std::optional<double> samples() const;
  /// Returns the time of training, updates and rendering, as `pharos render` counts it [s]; empty
  /// if the metadata does not state it.
  std::optional<double> seconds() const;
  /// Returns the exposure of the image's PNG [stops]; empty if the metadata does not state it.
  std::optional<double> exposure() const;
};

struct MeasuredImage {
  ImageFile source;
  ImageErrors errors;
};

struct Comparison {
  ImageFile reference;
  std::vector<MeasuredImage> images;  ///< at least one; ratios are relative to the first
  Display display;                    ///< for PSNR and FLIP

  /// Returns false for images with more invalid pixels than another image. Their errors are means
  /// over fewer pixels, so these images are neither best nor part of a ratio.
  bool is_comparable(std::size_t i) const;
  /// Returns whether image `i` has the best value of this metric. Returns false if all values are
  /// equal, and if there is only one image.
  bool is_best(std::size_t i, Metric metric) const;
  /// Returns the value of image `i` divided by the value of the first image. Returns empty for the
  /// first image, for metrics without ratios, and if the ratio is not a number.
  std::optional<double> ratio(std::size_t i, Metric metric) const;
};

/// Reads all files and measures every metric. Throws InputError, with one line that names the
/// files, if read_image() rejects a file, if an image has another size than the reference, no
/// channels R, G and B, or no pixel that is finite in both images, and if a file is named twice.
/// Without `exposure` [stops], images are exposed as the reference states, or the first image that
/// states an exposure, or not at all.
Comparison compare_files(std::span<const std::filesystem::path> images,
                         const std::filesystem::path& reference,
                         std::optional<double> exposure = {});

/// Returns a text table with one aligned column per image. The best value of each row is marked,
/// and ratios are relative to the first image.
std::string comparison_table(const Comparison& comparison);

/// Returns the comparison as JSON; docs/experiments/metrics.md has the schema.
std::string comparison_json(const Comparison& comparison);

/// Returns the comparison as a report page with the images, maps of relMSE, FLIP and HDR-FLIP, and
/// the configs.
Report comparison_report(const Comparison& comparison);

}  // namespace pharos
