#pragma once

#include <span>
#include <vector>

#include <pharos/experiments/metrics/pixel_pair.h>

/// The difference that people see when they switch between two images, 0 to 1 a pixel:
///
/// - Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild 2020, "FLIP: A Difference
///   Evaluator for Alternating Images", for images as a display shows them;
/// - Andersson, Nilsson, Shirley and Akenine-Möller 2021, "Visualizing Errors in Rendered High
///   Dynamic Range Images", for radiance: the worst of FLIP over a range of exposures.
namespace pharos {

/// Who looks at the image.
struct Viewer {
  /// Of the displayed image; 67 is a display 0.7 m and 3840 pixels wide seen from 0.7 m.
  double pixels_per_degree = 67;
};

/// FLIP of every pixel. Values are those of a display: linear, clipped to [0, 1].
std::vector<double> flip_errors(const PixelPair& pair, const Viewer& viewer = {});

/// The exposures that HDR-FLIP looks at, [stops] apart from the image's own.
struct ExposureRange {
  double first = 0, last = 0;
  int count = 2;
  double at(int i) const { return first + (last - first) * i / (count - 1); }
};

/// No more exposures than this, so that the time is bounded; the paper has no such bound. It leaves
/// out what is darker than the brightest pixel by more than so many stops.
inline constexpr int kMostExposures = 64;

/// From the exposure that shows the brightest pixel of the reference at 85 % of white to the one
/// that shows its median luminance so, about one a stop and at least two. The median is that of the
/// pixels that are not black when it would be 0; a black reference is seen at exposure 0. Negative
/// values count as 0.
ExposureRange exposure_range(std::span<const Rgb> reference);

/// HDR-FLIP of every pixel: the largest of FLIP over exposure_range(), after the tone mapping curve
/// of ACES (Narkowicz 2015).
std::vector<double> hdr_flip_errors(const PixelPair& pair, const Viewer& viewer = {});

}  // namespace pharos
