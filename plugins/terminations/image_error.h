#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <pharos/core/archive.h>

namespace pharos {

/// The mean squared error and the mean cost of the paths of one image. The largest errors of each
/// pass, the outliers, count as the smallest one of them: a single path that finds a small bright
/// light may have a larger error than all others together, and factors that follow it would serve
/// this path alone.
class ImageError {
 public:
  /// A pass has `pass` paths, and `outliers` of them are outliers. A last pass that is not full has
  /// as many outliers.
  ImageError(std::size_t outliers, std::uint64_t pass) : outliers_(outliers), pass_(pass) {}

  /// Adds a path of squared error `squared`, relative to its pixel [1], and of `cost` steps.
  void add(double squared, double cost);
  /// Forgets all paths.
  void clear() { *this = ImageError(outliers_, pass_); }

  /// Returns the mean squared error [1]; 0 if there are no paths.
  double squared() const;
  /// Returns the mean cost [steps]; 0 if there are no paths.
  double cost() const;
  /// Returns the squared error as which outliers count, a mean over the full passes [1]; 0 if there
  /// is no full pass or there are no outliers.
  double largest() const { return passes_ > 0 ? limits_ / passes_ : 0; }

  void archive(Archive& archive);

 private:
  std::size_t outliers_;
  std::uint64_t pass_;
  std::uint64_t in_pass_ = 0;       ///< number of paths of the pass that is not full
  std::vector<double> largest_;     ///< of this pass: a heap with the smallest one in front
  double squared_ = 0;              ///< sum over all paths, those in `largest_` not included
  double cost_ = 0, paths_ = 0;     ///< sums over all paths
  double limits_ = 0, passes_ = 0;  ///< sums over the full passes with outliers
};

}  // namespace pharos
