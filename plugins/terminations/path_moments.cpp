#include "path_moments.h"

#include <algorithm>
#include <cstddef>

namespace pharos {

PathMoments::PathMoments(const PixelRect& window) : window_(window), pixels_(window.area()) {}

void PathMoments::add(Vec2 film, double value, double cost) {
  const int x = std::clamp(static_cast<int>(film.x), window_.x0, window_.x1 - 1);
  const int y = std::clamp(static_cast<int>(film.y), window_.y0, window_.y1 - 1);
  Pixel& pixel = pixels_[window_.index(x, y)];
  pixel.weight += 1;
  pixel.squared_weight += 1;
  pixel.sum += value;
  pixel.squares += value * value;
  cost_ += cost;
  paths_ += 1;
}

void PathMoments::forget(double factor) {
  for (Pixel& pixel : pixels_) {
    pixel.weight *= factor;
    pixel.squared_weight *= factor * factor;
    pixel.sum *= factor;
    pixel.squares *= factor;
  }
  cost_ *= factor;
  paths_ *= factor;
}

/// The unbiased estimate of the variance from weighted values.
double PathMoments::Pixel::variance() const {
  const double degrees = weight - squared_weight / weight;
  return std::max(squares - sum * sum / weight, 0.0) / degrees;
}

double PathMoments::relative_variance(const PixelMap& estimates) const {
  constexpr double kLeastDegrees = 1e-3;  // a pixel with one path has none, up to rounding
  double sum = 0;
  std::size_t count = 0;
  for (int y = window_.y0; y < window_.y1; ++y) {
    for (int x = window_.x0; x < window_.x1; ++x) {
      const Pixel& pixel = pixels_[window_.index(x, y)];
      if (!(pixel.weight - pixel.squared_weight / pixel.weight > kLeastDegrees)) continue;
      const double radiance =
          estimates.at({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f});
      sum += pixel.variance() / (radiance * radiance);
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

void PathMoments::archive(Archive& archive) {
  const std::size_t count = pixels_.size();
  archive(pixels_, cost_, paths_);
  bool is_sound = pixels_.size() == count && cost_ >= 0 && paths_ >= 0;
  for (const Pixel& pixel : pixels_) is_sound &= pixel.weight >= 0 && pixel.squares >= 0;
  archive.expect(is_sound, "what was learned of pixels");
}

}  // namespace pharos
