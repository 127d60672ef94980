#include "pixel_estimates.h"

#include <algorithm>

#include <pharos/core/parallel.h>
#include <pharos/core/saved_rect.h>

namespace pharos::practical_path_guiding {

PixelEstimates::PixelEstimates(const PixelRect& window)
    : window_(window),
      pixels_(static_cast<std::size_t>(window.area())),
      new_(pixels_.size()),
      estimates_(pixels_.size(), 1) {}

std::size_t PixelEstimates::index(Vec2 film) const {
  return window_.index(std::clamp(static_cast<int>(film.x), window_.x0, window_.x1 - 1),
                       std::clamp(static_cast<int>(film.y), window_.y0, window_.y1 - 1));
}

void PixelEstimates::add(Vec2 film, double value) {
  Pixel& pixel = new_[index(film)];
  pixel.sum += value;
  ++pixel.paths;
}

void PixelEstimates::update(int radius, double least) {
  double sum = 0, paths = 0;
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    pixels_[i].sum += new_[i].sum;
    pixels_[i].paths += new_[i].paths;
    new_[i] = {};
    sum += pixels_[i].sum;
    paths += pixels_[i].paths;
  }
  if (!(sum > 0)) return;
  const double floor = least * sum / paths;
  parallel_for(static_cast<std::size_t>(window_.height()), [&](std::size_t row) {
    const int y = window_.y0 + static_cast<int>(row);
    for (int x = window_.x0; x < window_.x1; ++x) {
      const Pixel around = sum_around(x, y, radius);
      const double mean = around.paths > 0 ? around.sum / around.paths : 0;
      estimates_[window_.index(x, y)] = std::max(mean, floor);
    }
  });
}

PixelEstimates::Pixel PixelEstimates::sum_around(int x, int y, int radius) const {
  Pixel around;
  const int x_end = std::min(x + radius + 1, window_.x1);
  const int y_end = std::min(y + radius + 1, window_.y1);
  for (int v = std::max(y - radius, window_.y0); v < y_end; ++v) {
    for (int u = std::max(x - radius, window_.x0); u < x_end; ++u) {
      around.sum += pixels_[window_.index(u, v)].sum;
      around.paths += pixels_[window_.index(u, v)].paths;
    }
  }
  return around;
}

double PixelEstimates::at(Vec2 film) const {
  return estimates_[index(film)];
}

void PixelEstimates::archive(Archive& archive) {
  PixelRect window = window_;
  archive_rect(archive, window);
  if (window != window_) throw InputError("what was learned belongs to a film of another size");
  const std::size_t count = pixels_.size();
  archive(pixels_, new_, estimates_);
  bool is_sound = pixels_.size() == count && new_.size() == count && estimates_.size() == count;
  for (const double estimate : estimates_) is_sound &= estimate > 0;
  archive.expect(is_sound, "the estimates of the pixels");
}

}  // namespace pharos::practical_path_guiding
