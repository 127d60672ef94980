#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <pharos/core/archive.h>
#include <pharos/core/random.h>

namespace pharos::statistics {

/// A sample of at most `capacity` items of a weighted stream, by VAROPT (Cohen et al. 2009, "Stream
/// sampling for variance-optimal estimation of subset sums", algorithm 1). The items in the sample
/// have output weights. The expected output weight of an item is the weight that it came with. The
/// sum of the output weights is the sum of all weights so far, to rounding, whatever the order.
/// Heavy items keep their own weights; all other items share one weight, the threshold. Memory is
/// constant once the sample holds `capacity` items.
template <class Item>
class VarOptReservoir {
 public:
  /// An item with its output weight.
  struct Entry {
    Item item;
    double weight;
    void archive(Archive& archive) { archive(item, weight); }
  };

  /// Makes an empty reservoir. Requires `capacity` > 0.
  explicit VarOptReservoir(std::size_t capacity) : capacity_(capacity) {}
  /// Takes an item; weights that are not positive and finite are ignored. Draws at most one number.
  void insert(const Item& item, double weight, RandomStream& random) {
    if (!(weight > 0) || !std::isfinite(weight)) return;
    total_ += weight;
    if (size() < capacity_) {
      push_heavy({item, weight});
      return;
    }
    // One item will be dropped: a light item or a candidate. Light items share one weight.
    // Candidates have weights below the new threshold, which is not known yet.
    candidates_.clear();
    double sum = threshold_ * static_cast<double>(light_.size());
    if (weight > threshold_) {
      push_heavy({item, weight});
    } else {
      candidates_.push_back({item, weight});
      sum += weight;
    }
    const auto others = [&] { return static_cast<double>(light_.size() + candidates_.size()) - 1; };
    while (!heavy_.empty() && sum >= others() * heavy_.front().weight) {
      candidates_.push_back(pop_heavy());
      sum += candidates_.back().weight;
    }
    const double old_threshold = std::exchange(threshold_, sum / others());
    drop_one(old_threshold, random);
    for (Entry& candidate : candidates_) light_.push_back(std::move(candidate.item));
  }

  std::size_t capacity() const { return capacity_; }
  std::size_t size() const { return heavy_.size() + light_.size(); }
  /// The sum of the weights of all items that were inserted.
  double total_weight() const { return total_; }
  /// The effective number of items in the sample (Kish 1965): the squared sum of their weights over
  /// the sum of their squared weights; 0 without items. A few heavy items count for few.
  double effective_size() const {
    double sum = 0, squares = 0;
    for_each([&](const Item&, double weight) {
      sum += weight;
      squares += weight * weight;
    });
    return squares > 0 ? sum * sum / squares : 0;
  }

  /// The items that keep their own weights, the items that share one weight, and this shared
  /// weight, the threshold.
  const std::vector<Entry>& heavy() const { return heavy_; }
  const std::vector<Item>& light() const { return light_; }
  double threshold() const { return threshold_; }

  /// Saves the sample, or loads it into a reservoir of the same capacity.
  void archive(Archive& archive) {
    archive(threshold_, total_, heavy_, light_);
    if (!archive.loads()) return;
    bool is_sound = threshold_ >= 0 && total_ >= 0 && size() <= capacity_ &&
                    (light_.empty() || threshold_ > 0) &&
                    std::is_heap(heavy_.begin(), heavy_.end(), is_heavier);
    for (const Entry& entry : heavy_) is_sound &= entry.weight > threshold_;
    archive.expect(is_sound, "the reservoir");
  }

  /// Calls `visit(item, output weight)` for every item.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (const Entry& entry : heavy_) visit(entry.item, entry.weight);
    for (const Item& item : light_) visit(item, threshold_);
  }

 private:
  static bool is_heavier(const Entry& a, const Entry& b) { return a.weight > b.weight; }

  void push_heavy(Entry entry) {
    heavy_.push_back(std::move(entry));
    std::push_heap(heavy_.begin(), heavy_.end(), is_heavier);
  }
  Entry pop_heavy() {
    std::pop_heap(heavy_.begin(), heavy_.end(), is_heavier);
    Entry entry = std::move(heavy_.back());
    heavy_.pop_back();
    return entry;
  }

  /// Drops one item. The probability of dropping an item is one minus the ratio of its weight to
  /// the new threshold. These probabilities add up to one.
  void drop_one(double old_threshold, RandomStream& random) {
    double u = static_cast<double>(random() >> 11) * 0x1p-53;
    for (Entry& candidate : candidates_) {
      u -= 1 - candidate.weight / threshold_;
      if (u < 0 || (light_.empty() && &candidate == &candidates_.back())) {
        candidate = std::move(candidates_.back());
        candidates_.pop_back();
        return;
      }
    }
    // All light items have the same probability. The divisor may be zero if only rounding led here,
    // so the index is clamped.
    const double share = u / (1 - old_threshold / threshold_);
    const double last = static_cast<double>(light_.size()) - 1;
    const auto index = static_cast<std::size_t>(std::min(std::max(0.0, share), last));
    light_[index] = std::move(light_.back());
    light_.pop_back();
  }

  std::size_t capacity_;
  std::vector<Entry> heavy_;       ///< a heap with the lightest item first; above the threshold
  std::vector<Item> light_;        ///< all have the weight `threshold_`
  std::vector<Entry> candidates_;  ///< scratch memory of insert()
  double threshold_ = 0;
  double total_ = 0;
};

}  // namespace pharos::statistics
