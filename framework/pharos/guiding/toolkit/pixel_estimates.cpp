#include <algorithm>
#include <cmath>

#include <pharos/core/parallel.h>
#include <pharos/core/saved_rect.h>
#include <pharos/guiding/toolkit/pixel_estimates.h>

namespace pharos {

PixelEstimates::PixelEstimates(const PixelRect& window)
    : window_(window),
      pixels_(static_cast<std::size_t>(window.area())),
      new_(pixels_.size()),
      estimates_(pixels_.size(), 1) {}

std::size_t PixelEstimates::index(Vec2 film) const {
  return window_.index(std::clamp(static_cast<int>(film.x), window_.x0, window_.x1 - 1),
                       std::clamp(static_cast<int>(film.y), window_.y0, window_.y1 - 1));
}

void PixelEstimates::add(Vec2 film, double value, double paths) {
  Pixel& pixel = new_[index(film)];
  pixel.sum += value;
  pixel.paths += paths;
}

void PixelEstimates::update(int radius, double least) {
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    pixels_[i].sum += new_[i].sum;
    pixels_[i].paths += new_[i].paths;
    new_[i] = {};
  }
  const Pixel all = sum_of_all();
  if (!(all.sum > 0)) return;
  mean_ = all.sum / all.paths;
  const double floor = least * all.sum / all.paths;
  parallel_for(static_cast<std::size_t>(window_.height()), [&](std::size_t row) {
    const int y = window_.y0 + static_cast<int>(row);
    for (int x = window_.x0; x < window_.x1; ++x) {
      const Pixel around = sum_around(x, y, radius);
      const double mean = around.paths > 0 ? around.sum / around.paths : 0;
      estimates_[window_.index(x, y)] = std::max(mean, floor);
    }
  });
}

PixelEstimates::Pixel PixelEstimates::sum_of_all() const {
  Pixel all;
  for (const Pixel& pixel : pixels_) {
    all.sum += pixel.sum;
    all.paths += pixel.paths;
  }
  return all;
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
  if (!archive.loads()) return;
  bool is_sound = pixels_.size() == count && new_.size() == count && estimates_.size() == count;
  for (const double estimate : estimates_) is_sound &= estimate > 0;
  const Pixel all = sum_of_all();
  mean_ = all.sum > 0 ? all.sum / all.paths : 1;
  is_sound &= mean_ > 0 && std::isfinite(mean_);
  archive.expect(is_sound, "the estimates of the pixels");
}

}  // namespace pharos
