#pragma once

#include <vector>

#include <pharos/core/image.h>

namespace pharos {

/// Combines images of the same scene (as made by Film::layers()) by inverse variance. Weights come
/// from other pixels than they weight, else bright outliers would lower their own weight and bias
/// the result: a pixel of one colour of the checkerboard is weighted by the mean variance of the
/// other colour. Images whose variance is unknown make all of them count by their samples.
class ImageCombiner {
 public:
  void add(Image layers) { images_.push_back(std::move(layers)); }
  bool empty() const { return images_.empty(); }
  /// The combination; there must be at least one image.
  Image combine() const;

 private:
  std::vector<Image> images_;
};

}  // namespace pharos
