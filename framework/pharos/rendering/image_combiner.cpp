#include <cmath>

#include <pharos/rendering/image_combiner.h>

namespace pharos {
namespace {

/// The share of the budget from which guides must have learned for images of full weight.
constexpr double kYoung = 1.0 / 8;

/// Returns the sum of the weights of the first `spent` of `total` units of the budget.
double weight_up_to(double spent, double total) {
  const double young = kYoung * total;
  return spent < young ? 0.5 * spent * spent / young : spent - 0.5 * young;
}

}  // namespace

void ImageCombiner::add(const Film& film, SpentBudget spent) {
  images_.push_back({film.layers(), film.samples_per_pixel(), spent});
  if (images_.size() > latest_) images_.erase(images_.begin());
}

Image ImageCombiner::combine() const {
  if (images_.size() == 1) return images_.front().layers;
  const double total_spent = images_.back().spent.end;
  const auto weight = [&](const Weighted& w) {
    return weight_up_to(w.spent.end, total_spent) - weight_up_to(w.spent.begin, total_spent);
  };
  double total = 0;
  for (const Weighted& w : images_) total += weight(w);
  const Image& first = images_.front().layers;
  const Weighted& last = images_.back();
  const int variance = first.channel_index("variance.R");
  const int samples = first.channel_index("samples.N");
  Image result(first.width(), first.height(), first.channels());
  for (const Weighted& w : images_) {
    const auto share = static_cast<float>(weight(w) / total);
    for (int y = 0; y < first.height(); ++y) {
      for (int x = 0; x < first.width(); ++x) {
        for (int c = 0; c < first.channel_count(); ++c) {
          const bool is_variance = c >= variance && c < variance + 3;
          const float factor = c == samples ? 1.0f : is_variance ? share * share : share;
          float value = w.layers.pixel(x, y)[c];
          if (is_variance && !std::isfinite(value)) {
            value = last.layers.pixel(x, y)[c] * static_cast<float>(last.samples / w.samples);
          }
          result.pixel(x, y)[c] += factor * value;
        }
      }
    }
  }
  return result;
}

}  // namespace pharos
