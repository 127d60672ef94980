#pragma once

#include <vector>

#include <pharos/core/image.h>
#include <pharos/rendering/film.h>

namespace pharos {

/// Combines images of the same scene by inverse variance. Weights come from other pixels than they
/// weight, else bright outliers would lower their own weight and bias the result: a pixel of one
/// colour of the checkerboard is weighted by the mean variance of the other colour. (Filters wider
/// than a pixel make neighbours share samples, which lets a little of that bias back in.) If any
/// image has too few passes to know its variance, all count by their samples.
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
    bool knows_variance;
  };
  std::vector<Weighted> images_;
};

}  // namespace pharos
