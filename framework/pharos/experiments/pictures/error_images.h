#pragma once

#include <filesystem>
#include <string>

#include <pharos/experiments/metrics/comparison.h>
#include <pharos/experiments/pictures/color_map.h>

namespace pharos {

/// Returns the file for the errors of the image `file`, such as PREFIX1-name-flip.png. `index` is
/// the number of the image among those compared, starting at 1. A prefix that ends in '/' is a
/// folder.
std::filesystem::path error_image_file(const std::string& prefix, std::size_t index,
                                       const std::filesystem::path& file, Metric metric);

/// Returns one color scale for the errors of all these maps: 0 to 1 for FLIP and HDR-FLIP,
/// otherwise the four decades below the value that one pixel in a thousand exceeds. NaN is ignored.
ColorScale error_scale(Metric metric, std::span<const Image> maps);

/// Writes the error_image_file() of every image, all with the same color scale, which is returned.
/// Throws RunError.
ColorScale write_error_images(const Comparison& comparison, Metric metric,
                              const std::string& prefix);

}  // namespace pharos
