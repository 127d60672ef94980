#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <pharos/core/saved_rect.h>
#include <pharos/rendering/pixel_noise.h>

namespace pharos {
namespace {

/// The weight of earlier iterations relative to the next one.
constexpr double kEarlier = 0.25;
/// Effective number of samples from which noise is estimated.
constexpr double kEnough = 8;
/// The share of the samples that all pixels get alike.
constexpr float kEven = 0.5f;
/// Largest share of a pixel before shares are scaled to the mean 1.
constexpr float kMost = 8;
/// Added to the brightness of pixels, relative to the mean of all pixels. Otherwise black parts of
/// an image would take too many samples.
constexpr double kDark = 0.1;

void scale_to_mean_1(std::vector<float>& shares) {
  const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
  const double factor = static_cast<double>(shares.size()) / sum;
  for (float& share : shares) share = static_cast<float>(factor * share);
}

}  // namespace

/// Sums over all samples of some pixels.
struct PixelNoise::Sums {
  double weight = 0, value = 0, squares = 0;
  double deviations = 0;  ///< squared, from the mean of their pixel
  double freedom = 0;     ///< degrees of freedom of `deviations`

  Sums() = default;
  explicit Sums(const Pixel& p) : weight(p.weight), value(p.value), squares(p.squares) {
    if (!(weight > 0)) return;
    freedom = std::max(0.0, weight - p.squared_weights / weight);
    deviations = freedom > 0 ? std::max(0.0, squares - value * value / weight) : 0;
  }

  void add(const Sums& other, double factor = 1) {
    weight += factor * other.weight;
    value += factor * other.value;
    squares += factor * other.squares;
    deviations += factor * other.deviations;
    freedom += factor * other.freedom;
  }
  /// Whether the samples are effectively enough to tell the noise.
  bool suffice() const { return freedom > 0 && squares > 0 && value * value >= kEnough * squares; }
};

/// Sums over rectangles that begin at the corner of the film.
class PixelNoise::Table {
 public:
  Table(const PixelRect& window, const std::vector<Pixel>& pixels)
      : width_(window.width()),
        height_(window.height()),
        sums_(static_cast<std::size_t>(width_ + 1) * static_cast<std::size_t>(height_ + 1)) {
    for (int y = 0; y < height_; ++y) {
      Sums row;
      for (int x = 0; x < width_; ++x) {
        row.add(Sums(pixels[static_cast<std::size_t>(y) * width_ + x]));
        Sums& sum = sums_[index(x + 1, y + 1)];
        sum = at(x + 1, y);
        sum.add(row);
      }
    }
  }

  const Sums& whole() const { return at(width_, height_); }
  /// Returns the sums over the smallest square around (x, y) with enough samples, as far as it is
  /// on the film.
  Sums enough_around(int x, int y) const {
    for (int radius = 1; radius < std::max(width_, height_); radius *= 2) {
      const Sums sums = around(x, y, radius);
      if (sums.suffice()) return sums;
    }
    return whole();
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * (width_ + 1) + static_cast<std::size_t>(x);
  }
  const Sums& at(int x, int y) const { return sums_[index(x, y)]; }
  Sums around(int x, int y, int radius) const {
    const int x0 = std::max(x - radius, 0), x1 = std::min(x + radius + 1, width_);
    const int y0 = std::max(y - radius, 0), y1 = std::min(y + radius + 1, height_);
    Sums sums = at(x1, y1);
    sums.add(at(x0, y0));
    sums.add(at(x0, y1), -1);
    sums.add(at(x1, y0), -1);
    return sums;
  }

  int width_, height_;
  std::vector<Sums> sums_;
};

void PixelNoise::add(const Film& film) {
  window_ = film.window();
  pixels_.resize(window_.area());
  for (int y = window_.y0; y < window_.y1; ++y) {
    for (int x = window_.x0; x < window_.x1; ++x) {
      const SampleSums now = film.sample_sums(x, y);
      Pixel& pixel = pixels_[window_.index(x, y)];
      pixel.weight = kEarlier * pixel.weight + now.count;
      pixel.squared_weights = kEarlier * kEarlier * pixel.squared_weights + now.count;
      pixel.value = kEarlier * pixel.value + now.value;
      pixel.squares = kEarlier * pixel.squares + now.squares;
    }
  }
}

PixelShares PixelNoise::shares() const {
  if (pixels_.empty()) return {};
  const Table table(window_, pixels_);
  if (!(table.whole().deviations > 0) || !std::isfinite(table.whole().squares)) return {};
  const double dark = kDark * table.whole().value / table.whole().weight;
  std::vector<float> shares(pixels_.size());
  for (int y = 0; y < window_.height(); ++y) {
    for (int x = 0; x < window_.width(); ++x) {
      const Sums sums = table.enough_around(x, y);
      const double variance = std::max(sums.deviations, 0.0) / sums.freedom;
      shares[static_cast<std::size_t>(y) * window_.width() + x] =
          static_cast<float>(std::sqrt(variance / (sums.value / sums.weight + dark)));
    }
  }
  scale_to_mean_1(shares);
  for (float& share : shares) share = std::min(kEven + (1 - kEven) * share, kMost);
  scale_to_mean_1(shares);
  return {window_, std::move(shares)};
}

void PixelNoise::archive(Archive& archive) {
  archive_rect(archive, window_);
  archive.block(pixels_);
  archive.expect(pixels_.size() == window_.area(), "the noise of the pixels");
}

}  // namespace pharos
