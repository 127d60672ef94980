#pragma once

#include <cstdint>
#include <vector>

#include <pharos/core/image.h>
#include <pharos/rendering/film.h>

namespace pharos {

/// Combines images of the same scene that were rendered one after another, while guides learned.
///
/// Sample number s of a pixel, of N in all, has the weight min(1, 8 s / N). Guides that have
/// learned from less than an eighth of all samples may make much noisier images, so these count
/// less. If all images are equally noisy, the variance is up to 4 % larger than with equal weights.
///
/// With a budget of samples, the weights depend on nothing that an image shows, so the combination
/// is unbiased. As long as no image is left out, this holds even if the iterations end where their
/// paths decide, because the sum of all weights stays the same. With a budget of time, N depends a
/// little on how long the paths were. Weights by inverse variance would be biased: when an image
/// happens to find light, the guides learn from it, and the variance of later images is lower.
class ImageCombiner {
 public:
  /// Only the `latest` images are combined; at least 1.
  explicit ImageCombiner(std::uint32_t latest) : latest_(latest) {}

  /// Adds the layers of a film that has samples. `before` is the number of samples per pixel that
  /// were taken before it, whether or not their images were added.
  void add(const Film& film, double before);
  bool empty() const { return images_.empty(); }
  /// Returns the combination. There must be at least one image. The variance of an image of a
  /// single pass is unknown; the variance of one sample is then taken from the last image.
  Image combine() const;

  void archive(Archive& archive) { archive(images_); }

 private:
  struct Weighted {
    Image layers;
    double begin = 0, end = 0;  ///< range of its samples among all samples of a pixel

    void archive(Archive& archive) { archive(layers, begin, end); }
    double samples() const { return end - begin; }
  };
  std::uint32_t latest_;
  std::vector<Weighted> images_;
};

}  // namespace pharos
