#pragma once

#include <span>
#include <vector>

#include <pharos/experiments/metrics/pixel_pair.h>

/// The difference that people see when they switch between two images, 0 to 1 for each pixel:
///
/// - Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild 2020, "FLIP: A Difference
///   Evaluator for Alternating Images", for images as a display shows them;
/// - Andersson, Nilsson, Shirley and Akenine-Möller 2021, "Visualizing Errors in Rendered High
///   Dynamic Range Images", for radiance: the largest FLIP over a range of exposures.
namespace pharos {

/// The viewing conditions.
struct Viewer {
  /// Pixels of the displayed image per degree. 67 is a display 0.7 m and 3840 pixels wide, seen
  /// from 0.7 m.
  double pixels_per_degree = 67;
};

/// Returns the FLIP error of every pixel. Values are interpreted as a display shows them: linear,
/// clipped to [0, 1].
std::vector<double> flip_errors(const PixelPair& pair, const Viewer& viewer = {});

/// The exposures that HDR-FLIP evaluates [stops], relative to the exposure of the image.
struct ExposureRange {
  double first = 0, last = 0;
  int count = 2;
  double at(int i) const { return first + (last - first) * i / (count - 1); }
};

/// The largest number of exposures. It bounds the run time; the paper has no such bound. Parts of
/// the image that are darker than the brightest pixel by more than this number of stops are not
/// considered.
inline constexpr int kMostExposures = 64;

/// Returns the exposures from the one that shows the brightest pixel of the reference at 85 % of
/// white to the one that shows its median luminance at 85 % of white. There is about one exposure
/// per stop, and there are at least two. If the median is 0, the median of the pixels that are not
/// black is used. A black reference is viewed at exposure 0. Negative values count as 0.
ExposureRange exposure_range(std::span<const Rgb> reference);

/// Returns the HDR-FLIP error of every pixel: the largest FLIP over exposure_range(), after the
/// tone mapping curve of ACES (Narkowicz 2015).
std::vector<double> hdr_flip_errors(const PixelPair& pair, const Viewer& viewer = {});

}  // namespace pharos
