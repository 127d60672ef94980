#pragma once

#include <vector>

#include <pharos/core/image.h>
#include <pharos/rendering/film.h>

namespace pharos {

/// Combines images of the same scene, each weighted by its number of samples. Weights by inverse
/// variance would be biased for images of guides that learn, whichever part of the image the
/// variance is taken from: what one image happens to find lowers the variance of the next ones.
class ImageCombiner {
 public:
  /// Adds the layers of a film that has samples.
  void add(const Film& film);
  bool empty() const { return images_.empty(); }
  /// Returns the combination. There must be at least one image.
  Image combine() const;

 private:
  struct Weighted {
    Image layers;
    double samples;  ///< samples per pixel
  };
  std::vector<Weighted> images_;
};

}  // namespace pharos
