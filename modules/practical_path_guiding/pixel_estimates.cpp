#include "pixel_estimates.h"

#include <algorithm>

#include <pharos/core/binary_stream.h>
#include <pharos/core/parallel.h>

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

void PixelEstimates::merge(const PixelEstimates& other) {
  if (other.window_ != window_) {
    throw InputError("learning on films of different sizes cannot be merged");
  }
  for (std::size_t i = 0; i < new_.size(); ++i) {
    new_[i].sum += other.new_[i].sum;
    new_[i].paths += other.new_[i].paths;
  }
}

void PixelEstimates::save(std::ostream& out) const {
  for (const int edge : {window_.x0, window_.y0, window_.x1, window_.y1}) save_number(out, edge);
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    for (const Pixel& pixel : {pixels_[i], new_[i]}) {
      save_number(out, pixel.sum);
      save_number(out, pixel.paths);
    }
    save_number(out, estimates_[i]);
  }
}

void PixelEstimates::load(std::istream& in) {
  for (const int edge : {window_.x0, window_.y0, window_.x1, window_.y1}) {
    if (load_number<int>(in) != edge) {
      throw InputError("what was learned belongs to a film of another size");
    }
  }
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    for (Pixel* pixel : {&pixels_[i], &new_[i]}) {
      pixel->sum = load_finite<double>(in);
      pixel->paths = load_finite<double>(in);
    }
    estimates_[i] = load_finite<double>(in);
    if (!(estimates_[i] > 0)) throw InputError("the estimates of the pixels are damaged");
  }
}

}  // namespace pharos::practical_path_guiding
