#pragma once

#include <vector>

#include <pharos/core/archive.h>
#include <pharos/core/pixel_rect.h>
#include <pharos/core/vec.h>

#include "pixel_map.h"

namespace pharos {

/// The variance of the values of paths within pixels, and the mean cost of a path. Earlier
/// iterations count less, because their paths ended and split by other rules.
class PathMoments {
 public:
  explicit PathMoments(const PixelRect& window);

  /// Adds a path that ends at a film position [pixels].
  void add(Vec2 film, double value, double cost);
  /// Scales the weight of all paths so far.
  void forget(double factor);

  /// Returns the mean over all pixels of the variance of a path over the squared radiance of the
  /// pixel in `estimates` [1]. Returns 0 if no pixel has two paths.
  double relative_variance(const PixelMap& estimates) const;
  /// Returns the mean cost of a path [steps]; 0 if there is none.
  double cost() const { return paths_ > 0 ? cost_ / paths_ : 0; }

  void archive(Archive& archive);

 private:
  struct Pixel {
    double weight = 0, squared_weight = 0;  ///< of the paths
    double sum = 0, squares = 0;            ///< of their values
    double variance() const;
    void archive(Archive& archive) { archive(weight, squared_weight, sum, squares); }
  };

  PixelRect window_;
  std::vector<Pixel> pixels_;
  double cost_ = 0, paths_ = 0;
};

}  // namespace pharos
