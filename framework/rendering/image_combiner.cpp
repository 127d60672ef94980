#include <algorithm>
#include <array>

#include <pharos/rendering/image_combiner.h>

namespace pharos {
namespace {

/// Weights of the two colours of the checkerboard.
using ParityWeights = std::array<double, 2>;

/// Inverse of the mean variance of the complementary colour.
ParityWeights inverse_variances(const Image& image) {
  const int channel = image.channel_index("variance.R");
  ParityWeights sums{0, 0};
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      sums[static_cast<std::size_t>((x + y + 1) % 2)] += mean(image.rgb(x, y, channel));
    }
  }
  // An image without any noise is black or constant; no weight may be infinite for that.
  constexpr double kSmallest = 1e-30;
  return {1 / std::max(sums[0], kSmallest), 1 / std::max(sums[1], kSmallest)};
}

}  // namespace

void ImageCombiner::add(const Film& film) {
  images_.push_back({film.layers(), film.samples_per_pixel(), film.complete_passes() > 1});
}

Image ImageCombiner::combine() const {
  if (images_.size() == 1) return images_.front().layers;
  const bool by_variance = std::all_of(images_.begin(), images_.end(),
                                       [](const Weighted& w) { return w.knows_variance; });
  std::vector<ParityWeights> weights;
  for (const Weighted& w : images_) {
    weights.push_back(by_variance ? inverse_variances(w.layers)
                                  : ParityWeights{w.samples, w.samples});
  }
  ParityWeights totals{0, 0};
  for (const ParityWeights& w : weights) {
    totals[0] += w[0];
    totals[1] += w[1];
  }
  const Image& first = images_.front().layers;
  const int variance = first.channel_index("variance.R");
  const int samples = first.channel_index("samples.N");
  Image result(first.width(), first.height(), first.channels());
  for (std::size_t i = 0; i < images_.size(); ++i) {
    for (int y = 0; y < first.height(); ++y) {
      for (int x = 0; x < first.width(); ++x) {
        const auto parity = static_cast<std::size_t>((x + y) % 2);
        const auto share = static_cast<float>(weights[i][parity] / totals[parity]);
        for (int c = 0; c < first.channel_count(); ++c) {
          const bool is_variance = c >= variance && c < variance + 3;
          const float factor = c == samples ? 1.0f : is_variance ? share * share : share;
          result.pixel(x, y)[c] += factor * images_[i].layers.pixel(x, y)[c];
        }
      }
    }
  }
  return result;
}

}  // namespace pharos
