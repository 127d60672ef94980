#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <pharos/core/image.h>
#include <pharos/statistics/hypothesis.h>

/// Whether two sets of renders show the same image, within a stated power. Path tracing noise is
/// heavy-tailed, so single pixels cannot be tested: the observation is the mean of a region in one
/// render, and regions grow until enough contributions make such means nearly normal.
///
///     const auto a = ImageSide::of_renders(guided, 64), b = ImageSide::of_renders(unguided, 64);
///     const ImageAgreement result = compare_images(a, b);
///     CHECK_MESSAGE(result.proven(), result.summary());
namespace pharos::statistics {

/// A rectangle of pixels, upper bounds exclusive.
struct Region {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  double pixel_count() const { return static_cast<double>(x1 - x0) * (y1 - y0); }
};

/// One side of a comparison. Colors enter as the mean of channels R, G, B.
class ImageSide {
 public:
  /// At least two independent renders of one scene with unrelated seeds, of one size, with
  /// `samples_per_pixel` samples each. Throws InputError for fewer, for images of different sizes
  /// and for values that are not finite.
  static ImageSide of_renders(std::span<const Image> renders, double samples_per_pixel);
  /// A reference as two independent halves; its value is their mean, its error is estimated from
  /// the pixels' differences, summed over a region. Pixels must be independent (box filter).
  static ImageSide of_halves(const Image& a, const Image& b);
  /// The same for one image with channels a.R a.G a.B b.R b.G b.B.
  static ImageSide of_halves(const Image& both);

  int width() const { return width_; }
  int height() const { return height_; }

  /// The mean over a region [unit of the image], with its error.
  Estimate mean(const Region& region) const;
  /// Kish's effective number (sum w)^2 / sum w^2 of the contributions w that make up the region in
  /// one observation, from the spread of its pixels: a pixel of n samples with mean m and variance
  /// v holds sum w^2 = n^2 v + n m^2. Zero when nothing contributes.
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
  std::vector<std::vector<double>> observations_;  ///< renders or the two halves
  std::vector<double> pixel_mean_;                 ///< sum w, per pixel in units of 1/samples
  std::vector<double> pixel_second_;               ///< sum w^2, in units of 1/samples^2
};

/// The constants of the protocol.
struct AgreementOptions {
  double family_level = 0.01;            ///< family-wise error rate of all tests of one comparison
  int block_size = 8;                    ///< smallest region [pixels]
  double effective_contributions = 200;  ///< in every region, on both sides: below, false alarms
                                         ///< are several times the nominal rate
  double power = 0.9;                    ///< with which the detectable bias is found
  double image_bias = 0.02;              ///< largest detectable bias of a valid test, of the mean
  double region_bias = 0.10;             ///< the same for regions, of the region's mean
  double rounding = 1e-6;                ///< relative standard error of single precision, added
};

/// One test of the family.
struct RegionTest {
  Region region;
  Estimate a, b;
  double effective_contributions = 0;  ///< the smaller of both sides
  double p_value = 1;
  double adjusted_p = 1;       ///< Holm over the family
  double detectable_bias = 0;  ///< relative to the mean of both sides [1]
};

struct ImageAgreement {
  bool agree = false;  ///< no test of the family is rejected
  bool valid = false;  ///< there are regions, each with enough contributions and power
  RegionTest whole_image;
  std::vector<RegionTest> regions;
  double smallest_adjusted_p = 1;
  double median_region_bias = 0;  ///< detectable, relative [1]
  double worst_region_bias = 0;   ///< detectable, relative [1]

  /// The images agree, and a test that could have told said so.
  bool proven() const { return agree && valid; }
  /// One line for logs: verdict, p-value, means and power.
  std::string summary() const;
};

/// Tests whether the expected images of both sides are equal: Welch's t-test for the whole image
/// and for every region, Holm-corrected. Regions are blocks merged by quadtree until they hold
/// enough contributions; blocks without any contribution on both sides are left out. Detectable
/// biases are those at the strictest level of Holm's procedure. Throws InputError when sizes
/// differ.
ImageAgreement compare_images(const ImageSide& a, const ImageSide& b,
                              const AgreementOptions& options = {});

}  // namespace pharos::statistics
