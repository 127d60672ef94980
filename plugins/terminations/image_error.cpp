#include "image_error.h"

#include <algorithm>
#include <functional>

namespace pharos {

void ImageError::add(double squared, double cost) {
  largest_.push_back({squared, cost});
  std::push_heap(largest_.begin(), largest_.end(), std::greater<>());
  if (largest_.size() > outliers_) {
    std::pop_heap(largest_.begin(), largest_.end(), std::greater<>());
    sum_.squared += largest_.back().squared;
    sum_.cost += largest_.back().cost;
    ++paths_;
    largest_.pop_back();
  }
  if (++in_pass_ < pass_) return;
  in_pass_ = 0;
  largest_.clear();
}

double ImageError::squared() const {
  return paths_ > 0 ? sum_.squared / paths_ : 0;
}

double ImageError::cost() const {
  return paths_ > 0 ? sum_.cost / paths_ : 0;
}

void ImageError::archive(Archive& archive) {
  archive(largest_, in_pass_, sum_, paths_);
  bool is_sound = largest_.size() <= outliers_ && in_pass_ < std::max<std::uint64_t>(pass_, 1) &&
                  sum_.squared >= 0 && sum_.cost >= 0 &&
                  std::is_heap(largest_.begin(), largest_.end(), std::greater<>());
  for (const Path& path : largest_) is_sound &= path.squared >= 0 && path.cost >= 0;
  archive.expect(is_sound && paths_ >= 0, "the errors of paths");
}

}  // namespace pharos
