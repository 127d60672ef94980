#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <pharos/core/image.h>
#include <pharos/statistics/hypothesis.h>

/// Tests whether two sets of renders show the same image, with a stated power. Path tracing noise
/// is heavy-tailed, so single pixels cannot be tested. An observation is therefore the mean of a
/// region in one render. Regions grow until they hold enough contributions for nearly normal means.
///
///     const auto a = ImageSide::of_renders(guided, 64), b = ImageSide::of_renders(unguided, 64);
///     const ImageAgreement result = compare_images(a, b);
///     CHECK_MESSAGE(result.proven(), result.summary());
namespace pharos::statistics {

/// A rectangle of pixels. The upper bounds are exclusive.
struct Region {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  double pixel_count() const { return static_cast<double>(x1 - x0) * (y1 - y0); }
};

/// One side of a comparison. Colors are reduced to the mean of channels R, G, B.
class ImageSide {
 public:
  /// Makes a side from at least two independent renders of one scene with unrelated seeds, equal
  /// size and `samples_per_pixel` samples each. Throws InputError for fewer renders, for images of
  /// different sizes and for values that are not finite.
  static ImageSide of_renders(std::span<const Image> renders, double samples_per_pixel);
  /// Makes a side from a reference that consists of two independent halves. Its value is the mean
  /// of the halves. The error over a region is estimated from the differences between the halves,
  /// summed over the pixels of the region. Pixels must be independent (box filter).
  static ImageSide of_halves(const Image& a, const Image& b);
  /// Makes such a side from one image with channels a.R a.G a.B b.R b.G b.B.
  static ImageSide of_halves(const Image& both);

  int width() const { return width_; }
  int height() const { return height_; }

  /// Returns the mean over a region [unit of the image] with its error.
  Estimate mean(const Region& region) const;
  /// Returns Kish's effective number (sum w)^2 / sum w^2 of the contributions w to the region in
  /// one observation. The sums follow from the spread of the region's pixels: a pixel of n samples
  /// with mean m and variance v has sum w^2 = n^2 v + n m^2. Returns zero if nothing contributes.
  double effective_contributions(const Region& region) const;

 private:
  ImageSide() = default;
  static ImageSide of_halves(const Image& a, const std::string& layer_a, const Image& b,
                             const std::string& layer_b);
  void add_observation(const Image& image, const std::string& layer);
  void finish_pixels(double samples_per_pixel);
  double sum(const std::vector<double>& pixels, const Region& region) const;
  Estimate mean_of_renders(const Region& region) const;
  Estimate mean_of_halves(const Region& region) const;

  int width_ = 0, height_ = 0;
  bool halves_ = false;
  std::vector<std::vector<double>> observations_;  ///< the renders or the two halves
  std::vector<double> pixel_mean_;                 ///< sum w of each pixel, in units of 1/samples
  std::vector<double> pixel_second_;  ///< sum w^2 of each pixel, in units of 1/samples^2
};

/// The constants of the protocol.
struct AgreementOptions {
  double family_level = 0.01;            ///< family-wise error rate of all tests of one comparison
  int block_size = 8;                    ///< smallest region [pixels]
  double effective_contributions = 200;  ///< required in every region on both sides; with fewer,
                                         ///< false alarms are several times the nominal rate
  double power = 0.9;                    ///< probability with which a bias counts as detectable
  double image_bias = 0.02;   ///< largest detectable bias of a valid test, relative to the mean [1]
  double region_bias = 0.10;  ///< the same for each region, relative to the region's mean [1]
  double rounding = 1e-6;     ///< relative standard error added for single precision
};

/// One test of the family.
struct RegionTest {
  Region region;
  Estimate a, b;
  double effective_contributions = 0;  ///< the smaller number of both sides
  double p_value = 1;
  double adjusted_p = 1;       ///< by Holm over the family
  double detectable_bias = 0;  ///< relative to the mean of both sides [1]
};

struct ImageAgreement {
  bool agree = false;  ///< no test of the family is rejected
  bool valid =
      false;  ///< there are regions with enough contributions, and all tests have enough power
  RegionTest whole_image;
  std::vector<RegionTest> regions;
  double smallest_adjusted_p = 1;
  double median_region_bias = 0;  ///< median of the regions' detectable biases, relative [1]
  double worst_region_bias = 0;   ///< largest of the regions' detectable biases, relative [1]

  /// Returns whether the images agree and the tests had enough power to detect a difference.
  bool proven() const { return agree && valid; }
  /// Returns one line for logs: verdict, p-value, means and power.
  std::string summary() const;
};

/// Tests whether the expected images of both sides are equal: by Welch's t-test for the whole image
/// and for every region, Holm-corrected. Regions are blocks that are merged by a quadtree until
/// they hold enough contributions. Blocks to which neither side contributes are left out.
/// Detectable biases refer to the strictest level of Holm's procedure. Throws InputError if the
/// sizes differ.
ImageAgreement compare_images(const ImageSide& a, const ImageSide& b,
                              const AgreementOptions& options = {});

}  // namespace pharos::statistics
