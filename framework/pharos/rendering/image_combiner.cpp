#include <pharos/rendering/image_combiner.h>

namespace pharos {

void ImageCombiner::add(const Film& film) {
  images_.push_back({film.layers(), film.samples_per_pixel()});
}

Image ImageCombiner::combine() const {
  if (images_.size() == 1) return images_.front().layers;
  double total = 0;
  for (const Weighted& w : images_) total += w.samples;
  const Image& first = images_.front().layers;
  const int variance = first.channel_index("variance.R");
  const int samples = first.channel_index("samples.N");
  Image result(first.width(), first.height(), first.channels());
  for (const Weighted& w : images_) {
    const auto share = static_cast<float>(w.samples / total);
    for (int y = 0; y < first.height(); ++y) {
      for (int x = 0; x < first.width(); ++x) {
        for (int c = 0; c < first.channel_count(); ++c) {
          const bool is_variance = c >= variance && c < variance + 3;
          const float factor = c == samples ? 1.0f : is_variance ? share * share : share;
          result.pixel(x, y)[c] += factor * w.layers.pixel(x, y)[c];
        }
      }
    }
  }
  return result;
}

}  // namespace pharos
