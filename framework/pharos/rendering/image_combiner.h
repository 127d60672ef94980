#pragma once

#include <cstdint>
#include <vector>

#include <pharos/core/image.h>
#include <pharos/rendering/film.h>

namespace pharos {

/// The part of a budget that rendering an image took: samples per pixel or seconds of rendering,
/// counted from the beginning of the render.
struct SpentBudget {
  double begin = 0, end = 0;

  void archive(Archive& archive) { archive(begin, end); }
};

/// Combines images of the same scene that were rendered one after another, while guides learned.
///
/// An image has a weight for each unit of the budget that rendering it took: samples per pixel or
/// seconds. Unit number s of N in all has the weight min(1, 8 s / N). Guides that have learned from
/// less than an eighth of the budget may make much noisier images, so these count less. If all
/// images are equally efficient, the variance is up to 4 % larger than with equal weights. Where
/// paths split, a sample costs several times as much as before and has less noise. So samples of
/// different iterations are only comparable by their time.
///
/// With a budget of samples, the weights depend on nothing that an image shows, so the combination
/// is unbiased. As long as no image is left out, this holds even if the iterations end where their
/// paths decide, because the sum of all weights stays the same. With a budget of time, the weights
/// depend a little on how long the paths were. Weights by inverse variance would be biased: when an
/// image happens to find light, the guides learn from it, and the variance of later images is
/// lower.
class ImageCombiner {
 public:
  /// Only the `latest` images are combined; at least 1.
  explicit ImageCombiner(std::uint32_t latest) : latest_(latest) {}

  /// Adds the layers of a film that has samples, rendered with a part `spent` of the budget. All
  /// images before it count there, whether or not they were added.
  void add(const Film& film, SpentBudget spent);
  bool empty() const { return images_.empty(); }
  /// Returns the combination. There must be at least one image. The variance of an image of a
  /// single pass is unknown; the variance of one sample is then taken from the last image.
  Image combine() const;

  void archive(Archive& archive) { archive(images_); }

 private:
  struct Weighted {
    Image layers;
    double samples = 0;  ///< per pixel
    SpentBudget spent;

    void archive(Archive& archive) { archive(layers, samples, spent); }
  };
  std::uint32_t latest_;
  std::vector<Weighted> images_;
};

}  // namespace pharos
