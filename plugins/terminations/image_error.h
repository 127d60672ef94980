#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <pharos/core/archive.h>

namespace pharos {

/// The mean squared error and the mean cost of the paths of one image. The largest squared errors
/// are left out, together with their costs: a single path that finds a small bright light may have
/// a larger one than all others together, and factors that follow it would serve this path alone.
class ImageError {
 public:
  /// Of each `pass` paths, `outliers` are left out. A last pass that is not full loses as many.
  ImageError(std::size_t outliers, std::uint64_t pass) : outliers_(outliers), pass_(pass) {}

  /// Adds a path of squared error `squared`, relative to its pixel [1], and of `cost` steps.
  void add(double squared, double cost);
  /// Forgets all paths.
  void clear() { *this = ImageError(outliers_, pass_); }

  /// Returns the mean squared error [1]; 0 if there are no paths but outliers.
  double squared() const;
  /// Returns the mean cost [steps]; 0 if there are no paths but outliers.
  double cost() const;

  void archive(Archive& archive);

 private:
  struct Path {
    double squared = 0, cost = 0;
    friend bool operator>(const Path& a, const Path& b) { return a.squared > b.squared; }
    void archive(Archive& archive) { archive(squared, cost); }
  };

  std::size_t outliers_;
  std::uint64_t pass_;
  std::uint64_t in_pass_ = 0;  ///< number of paths of the pass that is not full
  std::vector<Path> largest_;  ///< of this pass: a heap with the smallest one in front
  Path sum_;                   ///< of all paths but outliers
  double paths_ = 0;           ///< number of all paths but outliers
};

}  // namespace pharos
