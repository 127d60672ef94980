#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <pharos/core/random.h>

namespace pharos::statistics {

/// A sample of at most `capacity` items of a weighted stream: VAROPT (Cohen et al. 2009, "Stream
/// sampling for variance-optimal estimation of subset sums", algorithm 1). Items stay with output
/// weights whose expectations are the weights that they came with, and whose sum is that of all
/// weights so far, to rounding, whatever the order. Heavy items keep their own weights; all others
/// share one, the threshold. Memory is constant once `capacity` items are in.
template <class Item>
class VarOptReservoir {
 public:
  /// An item with its output weight.
  struct Entry {
    Item item;
    double weight;
  };

  /// `capacity` > 0.
  explicit VarOptReservoir(std::size_t capacity) : capacity_(capacity) {}
  /// As it was: with what the functions of these names returned.
  VarOptReservoir(std::size_t capacity, double threshold, double total_weight,
                  std::vector<Entry> heavy, std::vector<Item> light)
      : capacity_(capacity),
        heavy_(std::move(heavy)),
        light_(std::move(light)),
        threshold_(threshold),
        total_(total_weight) {
    // A heap stays as it is: making it anew would exchange equals.
    if (std::is_heap(heavy_.begin(), heavy_.end(), is_heavier)) return;
    std::make_heap(heavy_.begin(), heavy_.end(), is_heavier);
  }

  /// Takes an item; weights that are not positive and finite are ignored. Draws at most one number.
  void insert(const Item& item, double weight, RandomStream& random) {
    if (!(weight > 0) || !std::isfinite(weight)) return;
    total_ += weight;
    if (size() < capacity_) {
      push_heavy({item, weight});
      return;
    }
    // What is up for being dropped: the light items, of one weight, and the candidates, each below
    // the new threshold, once it is found.
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
  /// The sum of all weights that came.
  double total_weight() const { return total_; }

  /// The items that keep their own weights, and those that share one, the threshold.
  const std::vector<Entry>& heavy() const { return heavy_; }
  const std::vector<Item>& light() const { return light_; }
  double threshold() const { return threshold_; }

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

  /// Drops one item: each with the probability that its weight lacks to the new threshold. All of
  /// them together lack one.
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
    // Of the light items, all alike; nothing is left to divide where only rounding came this far.
    const double share = u / (1 - old_threshold / threshold_);
    const double last = static_cast<double>(light_.size()) - 1;
    const auto index = static_cast<std::size_t>(std::min(std::max(0.0, share), last));
    light_[index] = std::move(light_.back());
    light_.pop_back();
  }

  std::size_t capacity_;
  std::vector<Entry> heavy_;       ///< a heap, the lightest first; above the threshold
  std::vector<Item> light_;        ///< of weight `threshold_`
  std::vector<Entry> candidates_;  ///< scratch
  double threshold_ = 0;
  double total_ = 0;
};

}  // namespace pharos::statistics
