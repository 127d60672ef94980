#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/core.h>

#include <pharos/core/error.h>
#include <pharos/statistics/image_agreement.h>

namespace pharos::statistics {
namespace {

/// Returns the mean of channels R, G and B for each pixel. The names of the channels begin with
/// `layer`.
std::vector<double> gray_pixels(const Image& image, const std::string& layer) {
  const int r = image.channel_index(layer + "R"), g = image.channel_index(layer + "G"),
            b = image.channel_index(layer + "B");
  if (r < 0 || g < 0 || b < 0) {
    throw InputError(fmt::format("the image lacks the channels {0}R, {0}G, {0}B", layer));
  }
  std::vector<double> pixels;
  pixels.reserve(static_cast<std::size_t>(image.width()) * image.height());
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const float* p = image.pixel(x, y);
      const double value = (double{p[r]} + p[g] + p[b]) / 3;
      if (!std::isfinite(value)) {
        throw InputError(fmt::format("pixel ({}, {}) is not finite", x, y));
      }
      pixels.push_back(value);
    }
  }
  return pixels;
}

/// Finds the regions to test.
class RegionFinder {
 public:
  RegionFinder(const ImageSide& a, const ImageSide& b, const AgreementOptions& options)
      : a_(a), b_(b), block_size_(options.block_size), enough_(options.effective_contributions) {}

  std::vector<Region> find() const {
    int size = block_size_;
    while (size < std::max(a_.width(), a_.height())) size *= 2;
    return divide(0, 0, size).regions;
  }

  double contributions(const Region& region) const {
    return std::min(a_.effective_contributions(region), b_.effective_contributions(region));
  }

 private:
  struct Division {
    std::vector<Region> regions;
    bool sufficient = true;
  };

  bool is_dark(const Region& region) const {
    return std::max(a_.effective_contributions(region), b_.effective_contributions(region)) == 0;
  }

  /// Returns the regions of the square at (x, y): the regions of its quarters, or the square itself
  /// if a quarter has too few contributions.
  Division divide(int x, int y, int size) const {
    const Region region{x, y, std::min(x + size, a_.width()), std::min(y + size, a_.height())};
    if (region.x0 >= region.x1 || region.y0 >= region.y1 || is_dark(region)) return {};
    if (size > block_size_) {
      Division all;
      for (int quarter = 0; quarter < 4; ++quarter) {
        const int half = size / 2;
        const Division part = divide(x + half * (quarter & 1), y + half * (quarter >> 1), half);
        all.regions.insert(all.regions.end(), part.regions.begin(), part.regions.end());
        all.sufficient = all.sufficient && part.sufficient;
      }
      if (all.sufficient) return all;
    }
    return {{region}, contributions(region) >= enough_};
  }

  const ImageSide& a_;
  const ImageSide& b_;
  int block_size_;
  double enough_;
};

Estimate with_rounding(Estimate e, double relative) {
  e.squared_error += relative * e.mean * relative * e.mean;
  return e;
}

RegionTest test_region(const ImageSide& a, const ImageSide& b, const Region& region,
                       double rounding) {
  RegionTest test{.region = region,
                  .a = with_rounding(a.mean(region), rounding),
                  .b = with_rounding(b.mean(region), rounding)};
  test.p_value = welch_test(test.a, test.b).p_value;
  return test;
}

double relative_detectable(const RegionTest& test, double significance, double power) {
  const double mean = 0.5 * std::abs(test.a.mean + test.b.mean);
  const double difference = detectable_difference(test.a, test.b, significance, power);
  return difference == 0 ? 0 : difference / mean;
}

/// Sets the fields of `result` that state the power and validity of its tests.
void judge_power(ImageAgreement& result, const AgreementOptions& options) {
  std::vector<double> biases;
  bool sufficient = !result.regions.empty();
  for (const RegionTest& test : result.regions) {
    biases.push_back(test.detectable_bias);
    sufficient = sufficient && test.effective_contributions >= options.effective_contributions;
  }
  if (!biases.empty()) {
    const auto middle = biases.begin() + static_cast<std::ptrdiff_t>(biases.size() / 2);
    std::nth_element(biases.begin(), middle, biases.end());
    result.median_region_bias = *middle;
    result.worst_region_bias = *std::max_element(biases.begin(), biases.end());
  }
  result.valid = sufficient && result.whole_image.detectable_bias <= options.image_bias &&
                 result.worst_region_bias <= options.region_bias;
}

}  // namespace

ImageSide ImageSide::of_renders(std::span<const Image> renders, double samples_per_pixel) {
  if (renders.size() < 2) throw InputError("a comparison needs at least two renders a side");
  ImageSide side;
  for (const Image& render : renders) side.add_observation(render, "");
  side.finish_pixels(samples_per_pixel);
  return side;
}

ImageSide ImageSide::of_halves(const Image& a, const Image& b) {
  return of_halves(a, "", b, "");
}

ImageSide ImageSide::of_halves(const Image& both) {
  return of_halves(both, "a.", both, "b.");
}

ImageSide ImageSide::of_halves(const Image& a, const std::string& layer_a, const Image& b,
                               const std::string& layer_b) {
  ImageSide side;
  side.halves_ = true;
  side.add_observation(a, layer_a);
  side.add_observation(b, layer_b);
  side.finish_pixels(std::numeric_limits<double>::infinity());
  return side;
}

void ImageSide::add_observation(const Image& image, const std::string& layer) {
  if (observations_.empty()) width_ = image.width(), height_ = image.height();
  if (image.empty() || image.width() != width_ || image.height() != height_) {
    throw InputError(fmt::format("image of {} x {} pixels where {} x {} are expected",
                                 image.width(), image.height(), width_, height_));
  }
  observations_.push_back(gray_pixels(image, layer));
}

/// Computes the sums of each pixel. For halves, the observation is the mean of both, and its sample
/// count is unknown but large.
void ImageSide::finish_pixels(double samples_per_pixel) {
  const std::size_t pixels = observations_.front().size();
  pixel_mean_.resize(pixels);
  pixel_second_.resize(pixels);
  std::vector<double> values(observations_.size());
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t r = 0; r < values.size(); ++r) values[r] = observations_[r][i];
    const SampleMoments m = moments(values);
    pixel_mean_[i] = m.mean;
    pixel_second_[i] = m.variance / (halves_ ? 2 : 1) + m.mean * m.mean / samples_per_pixel;
  }
}

double ImageSide::sum(const std::vector<double>& pixels, const Region& region) const {
  double total = 0;
  for (int y = region.y0; y < region.y1; ++y) {
    const double* row = pixels.data() + static_cast<std::size_t>(y) * width_;
    for (int x = region.x0; x < region.x1; ++x) total += row[x];
  }
  return total;
}

double ImageSide::effective_contributions(const Region& region) const {
  const double first = sum(pixel_mean_, region);
  if (first == 0) return 0;
  return first * first / sum(pixel_second_, region);
}

Estimate ImageSide::mean(const Region& region) const {
  return halves_ ? mean_of_halves(region) : mean_of_renders(region);
}

Estimate ImageSide::mean_of_renders(const Region& region) const {
  std::vector<double> means;
  for (const auto& render : observations_) {
    means.push_back(sum(render, region) / region.pixel_count());
  }
  return estimate(moments(means));
}

Estimate ImageSide::mean_of_halves(const Region& region) const {
  double squares = 0, fourths = 0;
  for (int y = region.y0; y < region.y1; ++y) {
    for (int x = region.x0; x < region.x1; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * width_ + x;
      const double half_difference = 0.5 * (observations_[0][i] - observations_[1][i]);
      squares += half_difference * half_difference;
      fourths += half_difference * half_difference * half_difference * half_difference;
    }
  }
  const double n = region.pixel_count();
  // Satterthwaite's degrees of freedom of a sum of squares with one degree of freedom each, where
  // E[d^4] = 3 sigma^4.
  const double freedom = fourths > 0 ? 3 * squares * squares / fourths : n;
  return {sum(pixel_mean_, region) / n, squares / (n * n), std::clamp(freedom, 1.0, n)};
}

ImageAgreement compare_images(const ImageSide& a, const ImageSide& b,
                              const AgreementOptions& options) {
  if (a.width() != b.width() || a.height() != b.height()) {
    throw InputError(fmt::format("images of {} x {} and {} x {} pixels cannot be compared",
                                 a.width(), a.height(), b.width(), b.height()));
  }
  const RegionFinder finder(a, b, options);
  std::vector<Region> all = finder.find();
  all.push_back({0, 0, a.width(), a.height()});

  std::vector<RegionTest> tests;
  std::vector<double> p_values;
  for (const Region& region : all) {
    tests.push_back(test_region(a, b, region, options.rounding));
    p_values.push_back(tests.back().p_value);
  }
  const std::vector<double> adjusted = holm_adjusted(p_values);
  const double strictest = options.family_level / static_cast<double>(tests.size());
  ImageAgreement result;
  for (std::size_t i = 0; i < tests.size(); ++i) {
    tests[i].adjusted_p = adjusted[i];
    tests[i].detectable_bias = relative_detectable(tests[i], strictest, options.power);
    tests[i].effective_contributions = finder.contributions(tests[i].region);
    result.smallest_adjusted_p = std::min(result.smallest_adjusted_p, adjusted[i]);
  }
  result.whole_image = tests.back();
  tests.pop_back();
  result.regions = std::move(tests);
  result.agree = result.smallest_adjusted_p > options.family_level;
  judge_power(result, options);
  return result;
}

std::string ImageAgreement::summary() const {
  return fmt::format(
      "{}, {}: smallest adjusted p {:.3g} of {} regions and the whole; means {:.6g} and {:.6g}; "
      "detectable bias {:.2f} % of the image, {:.2f} % (median) and {:.2f} % (worst) of a region",
      agree ? "agree" : "DIFFER", valid ? "valid" : "TOO FEW SAMPLES", smallest_adjusted_p,
      regions.size(), whole_image.a.mean, whole_image.b.mean, 100 * whole_image.detectable_bias,
      100 * median_region_bias, 100 * worst_region_bias);
}

}  // namespace pharos::statistics
