#include "image_error.h"

#include <algorithm>
#include <functional>

namespace pharos {

void ImageError::add(double squared, double cost) {
  cost_ += cost;
  ++paths_;
  largest_.push_back(squared);
  std::push_heap(largest_.begin(), largest_.end(), std::greater<>());
  if (largest_.size() > outliers_) {
    std::pop_heap(largest_.begin(), largest_.end(), std::greater<>());
    squared_ += largest_.back();
    largest_.pop_back();
  }
  if (++in_pass_ < pass_) return;
  in_pass_ = 0;
  if (largest_.empty()) return;
  squared_ += largest_.front() * static_cast<double>(largest_.size());
  limits_ += largest_.front();
  ++passes_;
  largest_.clear();
}

double ImageError::squared() const {
  if (!(paths_ > 0)) return 0;
  const double outliers =
      largest_.empty() ? 0 : largest_.front() * static_cast<double>(largest_.size());
  return (squared_ + outliers) / paths_;
}

double ImageError::cost() const {
  return paths_ > 0 ? cost_ / paths_ : 0;
}

void ImageError::archive(Archive& archive) {
  archive(largest_, in_pass_, squared_, cost_, paths_, limits_, passes_);
  bool is_sound = largest_.size() <= outliers_ && in_pass_ < std::max<std::uint64_t>(pass_, 1) &&
                  squared_ >= 0 && cost_ >= 0 && paths_ >= 0 && limits_ >= 0 && passes_ >= 0 &&
                  std::is_heap(largest_.begin(), largest_.end(), std::greater<>());
  for (const double squared : largest_) is_sound &= squared >= 0;
  archive.expect(is_sound, "the errors of paths");
}

}  // namespace pharos
