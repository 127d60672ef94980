#pragma once

#include <vector>

#include <pharos/core/image.h>
#include <pharos/rendering/film.h>

namespace pharos {

/// Combines images of the same scene, each weighted by its samples. (Weights by inverse variance
/// are not free of bias where images are made by guides that learn, wherever in the image the
/// variance is taken from: what one image happens to find makes the variance of the next ones
/// lower.)
class ImageCombiner {
 public:
  /// Takes the layers of a film that has samples.
  void add(const Film& film);
  bool empty() const { return images_.empty(); }
  /// The combination; there must be at least one image.
  Image combine() const;

 private:
  struct Weighted {
    Image layers;
    double samples;  ///< a pixel
  };
  std::vector<Weighted> images_;
};

}  // namespace pharos
