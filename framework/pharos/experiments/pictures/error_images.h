#pragma once

#include <filesystem>
#include <string>

#include <pharos/experiments/metrics/comparison.h>
#include <pharos/experiments/pictures/color_map.h>

namespace pharos {

/// The file that shows the errors of the image `file`, number `index` of those compared, counted
/// from 1: PREFIX1-name-flip.png. A prefix that ends in '/' is a folder.
std::filesystem::path error_image_file(const std::string& prefix, std::size_t index,
                                       const std::filesystem::path& file, Metric metric);

/// Colors for errors of all these maps together: 0 to 1 for FLIP and HDR-FLIP; else the four
/// decades below the value that one pixel in a thousand exceeds. NaN is left out.
ColorScale error_scale(Metric metric, std::span<const Image> maps);

/// Writes the error_image_file() of every image, all in the same colors, which it returns. Throws
/// RunError.
ColorScale write_error_images(const Comparison& comparison, Metric metric,
                              const std::string& prefix);

}  // namespace pharos
