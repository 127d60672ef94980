#include <array>
#include <cmath>

#include <pharos/rendering/image_combiner.h>

namespace pharos {
namespace {

/// Weights of the two colours of the checkerboard.
using ParityWeights = std::array<double, 2>;

double total_samples(const Image& image) {
  const int channel = image.channel_index("samples.N");
  double sum = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) sum += image.pixel(x, y)[channel];
  }
  return sum;
}

/// Inverse of the mean variance of the complementary colour.
ParityWeights inverse_variances(const Image& image) {
  const int channel = image.channel_index("variance.R");
  ParityWeights sums{0, 0};
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      sums[static_cast<std::size_t>((x + y + 1) % 2)] += mean(image.rgb(x, y, channel));
    }
  }
  return {1 / sums[0], 1 / sums[1]};
}

bool usable(const ParityWeights& w) {
  return std::isfinite(w[0]) && std::isfinite(w[1]) && w[0] > 0 && w[1] > 0;
}

std::vector<ParityWeights> weights_of(const std::vector<Image>& images) {
  std::vector<ParityWeights> weights;
  bool all_usable = true;
  for (const Image& image : images) {
    weights.push_back(inverse_variances(image));
    all_usable &= usable(weights.back());
  }
  if (all_usable) return weights;
  weights.clear();
  for (const Image& image : images) {
    const double samples = total_samples(image);
    weights.push_back({samples, samples});
  }
  return weights;
}

}  // namespace

Image ImageCombiner::combine() const {
  if (images_.size() == 1) return images_.front();
  const std::vector<ParityWeights> weights = weights_of(images_);
  ParityWeights totals{0, 0};
  for (const ParityWeights& w : weights) {
    totals[0] += w[0];
    totals[1] += w[1];
  }
  const Image& first = images_.front();
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
          result.pixel(x, y)[c] += factor * images_[i].pixel(x, y)[c];
        }
      }
    }
  }
  return result;
}

}  // namespace pharos
