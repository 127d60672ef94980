#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <pharos/core/image.h>
#include <pharos/experiments/metrics/metrics.h>
#include <pharos/experiments/report/report.h>

/// Image files against a reference: measured once, shown as text, as JSON and as a page.
namespace pharos {

/// An image file and what Pharos wrote into it.
struct ImageFile {
  std::filesystem::path file;
  std::string label;  ///< short and different for all images of a comparison; "reference" for it
  Image image;        ///< R, G, B
  Metadata metadata;  ///< entries whose names begin with "pharos:"; none from other programs

  /// Samples a pixel; empty when not stated.
  std::optional<double> samples() const;
  /// Training, updates and rendering, as `pharos render` counts them [s]; empty when not stated.
  std::optional<double> seconds() const;
};

struct MeasuredImage {
  ImageFile source;
  ImageErrors errors;
};

struct Comparison {
  ImageFile reference;
  std::vector<MeasuredImage> images;  ///< at least one; the first is what ratios refer to

  /// False for images with more invalid pixels than another: their errors are means over fewer
  /// pixels, so they are neither best nor in a ratio.
  bool is_comparable(std::size_t i) const;
  /// Whether image `i` has the best value of this metric. None has where all are equal, one image
  /// included.
  bool is_best(std::size_t i, Metric metric) const;
  /// The value of image `i` over that of the first; empty for the first itself, for metrics without
  /// ratios, and where it is not a number.
  std::optional<double> ratio(std::size_t i, Metric metric) const;
};

/// Reads all files and measures by every metric. Throws InputError with one line that names the
/// files: for what read_image() refuses, for images of other sizes than the reference, without
/// channels R, G and B, without any pixel that is finite in both, and for a file named twice.
Comparison compare_files(std::span<const std::filesystem::path> images,
                         const std::filesystem::path& reference);

/// Aligned columns, an image each; the best of each row is marked, ratios are to the first image.
std::string comparison_table(const Comparison& comparison);

/// The same as JSON; docs/experiments/metrics.md has the schema.
std::string comparison_json(const Comparison& comparison);

/// The same as a page, with the images, maps of relMSE, FLIP and HDR-FLIP, and the configs.
Report comparison_report(const Comparison& comparison);

}  // namespace pharos
