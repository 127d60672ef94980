// Tests of the steps that adapt a mixture to its data, with plain numbers as components.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/guiding/toolkit/mixture_learning.h>

namespace pharos {
namespace {

/// A sample with a weight.
struct Find {
  double weight = 0;
};

/// The result of learn_when_enough() for some samples.
struct Lesson {
  std::vector<double> learned;  ///< weights of the samples passed to `learn`
  std::vector<double> waiting;  ///< weights of the samples that wait for more
  int lessons = 0;
};

std::vector<double> weights_of(std::span<const Find> samples) {
  std::vector<double> weights;
  for (const Find& s : samples) weights.push_back(s.weight);
  return weights;
}

std::vector<Find> finds_of(const std::vector<double>& weights) {
  std::vector<Find> samples;
  for (const double weight : weights) samples.push_back({weight});
  return samples;
}

/// Offers samples to a cell that needs four samples with light for its first mixture.
Lesson offered(const std::vector<double>& samples, bool is_known,
               const std::vector<double>& waiting = {}) {
  const std::vector<Find> finds = finds_of(samples);
  std::vector<Find> first = finds_of(waiting);
  Lesson result;
  learn_when_enough(std::span<const Find>(finds), is_known, 4, first,
                    [&](std::span<const Find> enough) {
                      result.learned = weights_of(enough);
                      ++result.lessons;
                    });
  result.waiting = weights_of(first);
  return result;
}

using Numbers = std::vector<double>;
using Indices = std::vector<std::size_t>;

/// Merges pairs of numbers into their means. The cost of a merge is the difference of the numbers.
class MergedNumbers {
 public:
  explicit MergedNumbers(Numbers numbers) : numbers_(std::move(numbers)) {}

  /// `stops_at_bound` limits costs to their bound.
  void merge(double threshold, bool stops_at_bound = false) {
    merge_cheapest_pairs(
        threshold, [&] { return numbers_.size(); },
        [&](std::size_t i, std::size_t j, double bound) {
          bounds_.push_back(bound);
          const double cost = std::abs(numbers_[i] - numbers_[j]);
          return stops_at_bound ? std::min(cost, bound) : cost;
        },
        [&](std::size_t i, std::size_t j) { join(i, j); });
  }

  const Numbers& numbers() const { return numbers_; }
  /// Returns the merged pairs, in the order of the merges.
  const std::vector<Indices>& pairs() const { return pairs_; }
  /// Returns the bounds of all requested costs.
  const Numbers& bounds() const { return bounds_; }

 private:
  void join(std::size_t i, std::size_t j) {
    pairs_.push_back({i, j});
    numbers_[i] = (numbers_[i] + numbers_[j]) / 2;
    numbers_.erase(numbers_.begin() + static_cast<std::ptrdiff_t>(j));
  }

  Numbers numbers_, bounds_;
  std::vector<Indices> pairs_;
};

Numbers merged(Numbers numbers, double threshold) {
  MergedNumbers merging(std::move(numbers));
  merging.merge(threshold);
  return merging.numbers();
}

/// Halves numbers. The divergence of a number is its value before halving.
struct HalvedNumbers {
  Numbers numbers;
  Indices changed = {};

  void halve(double threshold, std::size_t most, std::size_t indivisible = ~std::size_t{0}) {
    const Numbers divergences = numbers;
    changed = halve_worst(
        threshold, most, [&] { return numbers.size(); },
        [&](std::size_t k) { return divergences[k]; },
        [&](std::size_t k) {
          if (k == indivisible) return false;
          numbers[k] /= 2;
          numbers.push_back(numbers[k]);
          return true;
        });
  }
};

/// Splits numbers above 1 until none is left. An assessment sets the divergence of a number to the
/// number itself.
class SettledNumbers {
 public:
  SettledNumbers(Numbers numbers, Numbers divergences)
      : numbers_(std::move(numbers)), divergences_(std::move(divergences)) {}

  void settle(std::size_t most) {
    split_until_settled([&] { return assess(); }, [&] { return split(most); },
                        [&](const Indices& changed) { fit(changed); },
                        [&](std::size_t k, double assessment) { divergences_[k] = assessment; });
  }

  const Numbers& numbers() const { return numbers_; }
  const Numbers& divergences() const { return divergences_; }
  /// Returns the halves of each fit.
  const std::vector<Indices>& fitted() const { return fitted_; }
  /// Returns the names of the steps in their order.
  const std::string& steps() const { return steps_; }

 private:
  Numbers assess() {
    steps_ += "assess ";
    return numbers_;
  }
  Indices split(std::size_t most) {
    steps_ += "split ";
    return halve_worst(
        1, most, [&] { return numbers_.size(); }, [&](std::size_t k) { return divergences_[k]; },
        [&](std::size_t k) {
          numbers_[k] /= 2;
          numbers_.push_back(numbers_[k]);
          divergences_[k] = 0;
          divergences_.push_back(0);
          return true;
        });
  }
  void fit(const Indices& changed) {
    steps_ += "fit ";
    fitted_.push_back(changed);
  }

  Numbers numbers_, divergences_;
  std::vector<Indices> fitted_;
  std::string steps_;
};

}  // namespace

TEST_CASE("mixture learning: a cell that has a mixture learns from all samples, dark ones too") {
  const Lesson lesson = offered({0, 2, 0, 1}, true);
  CHECK(lesson.lessons == 1);
  CHECK(lesson.learned == Numbers{0, 2, 0, 1});
  CHECK(lesson.waiting.empty());
}

TEST_CASE("mixture learning: samples that found no light teach nothing") {
  for (const bool is_known : {false, true}) {
    for (const Numbers& samples : {Numbers{}, Numbers{0, 0, 0, 0, 0}}) {
      const Lesson lesson = offered(samples, is_known, {7});
      CHECK(lesson.lessons == 0);
      CHECK(lesson.waiting == Numbers{7});
    }
  }
}

TEST_CASE("mixture learning: few finds wait, without the dark samples around them") {
  const Lesson lesson = offered({0, 3, 0}, false, {1, 2});
  CHECK(lesson.lessons == 0);
  CHECK(lesson.waiting == Numbers{1, 2, 3});
}

TEST_CASE("mixture learning: enough finds teach, the earlier ones first") {
  const Lesson lesson = offered({0, 4, 0}, false, {1, 2, 3});
  CHECK(lesson.lessons == 1);
  CHECK(lesson.learned == Numbers{1, 2, 3, 0, 4, 0});
  CHECK(lesson.waiting.empty());
  CHECK(offered({1, 2, 3, 4}, false).learned == Numbers{1, 2, 3, 4});
}

TEST_CASE("mixture learning: systematic sampling keeps expected weights and the sum of weights") {
  const Numbers weights{0.5, 0, 3, 0.25, 0.25, 6, 1, 1};
  constexpr std::size_t kCount = 5;
  constexpr int kOffsets = 240;
  Numbers means(weights.size());
  for (int offset = 0; offset < kOffsets; ++offset) {
    double total = 0;
    Indices chosen;
    choose_systematically(
        weights.size(), kCount, (offset + 0.5) / kOffsets,
        [&](std::size_t i) { return weights[i]; },
        [&](std::size_t i, double weight) {
          means[i] += weight / kOffsets;
          total += weight;
          chosen.push_back(i);
        });
    CHECK(total == doctest::Approx(12));
    CHECK(chosen.size() <= kCount);
    CHECK(std::is_sorted(chosen.begin(), chosen.end()));
    // A share is 12 / 5, so samples with larger weights are always chosen.
    for (const std::size_t sure : {2, 5})
      CHECK(std::count(chosen.begin(), chosen.end(), sure) == 1);
  }
  for (std::size_t i = 0; i < weights.size(); ++i) {
    CAPTURE(i);
    CHECK(means[i] == doctest::Approx(weights[i]).epsilon(1e-9));
  }
}

TEST_CASE("mixture learning: a fit has enough samples for all components") {
  MixtureLearningSettings settings;
  CHECK(settings.most_fit_samples() == 2048);
  settings.most_components = 100;
  CHECK(settings.most_fit_samples() == 3200);
}

TEST_CASE("mixture learning: the cheapest pair is merged first, and costs follow the merges") {
  MergedNumbers merging({0, 10, 10.5, 1, 20});
  merging.merge(2);
  CHECK(merging.pairs() == std::vector<Indices>{{1, 2}, {0, 2}});
  CHECK(merging.numbers() == Numbers{0.5, 10.25, 20});
  // The third number is near the second one, but too far from the mean of the first two.
  CHECK(merged({0, 1, 2.1}, 1.2) == Numbers{0.5, 2.1});
  CHECK(merged({1, 2, 3, 4}, 100).size() == 1);
}

TEST_CASE("mixture learning: pairs are merged only if their cost is below the threshold") {
  CHECK(merged({0, 1}, 1) == Numbers{0, 1});
  CHECK(merged({0, 1}, 1.001) == Numbers{0.5});
  CHECK(merged({3, 3}, 0) == Numbers{3, 3});
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(merged({0, infinity, 1}, infinity) == Numbers{0.5, infinity});
  CHECK(merged({5}, 1) == Numbers{5});
  CHECK(merged({}, 1).empty());
}

TEST_CASE("mixture learning: costs may stop at their bound, the least cost so far") {
  const Numbers numbers{4, 9, 1, 2.5, 30, 8.25, 2};
  MergedNumbers whole(numbers), bounded(numbers);
  whole.merge(3);
  bounded.merge(3, true);
  CHECK(whole.pairs().size() > 2);
  CHECK(bounded.pairs() == whole.pairs());
  CHECK(bounded.numbers() == whole.numbers());
  // The second pair lowers the bound of the third pair. After the merge, one pair is left.
  MergedNumbers three({0, 5, 1});
  three.merge(2);
  CHECK(three.bounds() == Numbers{2, 2, 1, 2});
}

TEST_CASE("mixture learning: components above the threshold are halved") {
  HalvedNumbers halved{{1, 8, 3, 6, 2}};
  halved.halve(2, 100);
  CHECK(halved.numbers == Numbers{1, 4, 1.5, 3, 2, 4, 3, 1.5});
  CHECK(halved.changed == Indices{1, 2, 3, 5, 6, 7});
  HalvedNumbers good{{1, 2}};
  good.halve(2, 100);
  CHECK(good.numbers == Numbers{1, 2});
  CHECK(good.changed.empty());
}

TEST_CASE("mixture learning: the worst components are halved while there is room") {
  HalvedNumbers halved{{1, 8, 3, 9}};
  halved.halve(2, 6);
  CHECK(halved.numbers == Numbers{1, 4, 3, 4.5, 4.5, 4});
  CHECK(halved.changed == Indices{1, 3, 4, 5});
  HalvedNumbers equal{{5, 5}};
  equal.halve(2, 3);
  CHECK(equal.changed == Indices{0, 2});
  for (const std::size_t most : {1u, 2u}) {
    HalvedNumbers full{{5, 6}};
    full.halve(2, most);
    CHECK(full.numbers == Numbers{5, 6});
    CHECK(full.changed.empty());
  }
}

TEST_CASE("mixture learning: a component that cannot be halved leaves its room to the next one") {
  HalvedNumbers halved{{1, 8, 3, 6}};
  halved.halve(2, 5, 1);
  CHECK(halved.numbers == Numbers{1, 8, 3, 3, 3});
  CHECK(halved.changed == Indices{3, 4});
}

TEST_CASE("mixture learning: halves are fitted, assessed and split again until all are settled") {
  SettledNumbers settling({4, 1}, {4, 0});
  settling.settle(100);
  CHECK(settling.numbers() == Numbers{1, 1, 1, 1, 1});
  CHECK(settling.fitted() == std::vector<Indices>{{0, 2}, {0, 2, 3, 4}});
  CHECK(settling.steps() == "split fit assess split fit assess split ");
}

TEST_CASE("mixture learning: an assessment renews what is known of halves alone") {
  // The second number is too large as well, but its old divergence is below the threshold.
  SettledNumbers settling({2, 50}, {2, 0.5});
  settling.settle(100);
  CHECK(settling.numbers() == Numbers{1, 50, 1});
  CHECK(settling.divergences() == Numbers{1, 0.5, 1});
}

TEST_CASE("mixture learning: splitting ends where there is no room, or nothing to split") {
  SettledNumbers full({8, 1}, {8, 1});
  full.settle(3);
  CHECK(full.numbers() == Numbers{4, 1, 4});
  CHECK(full.divergences() == Numbers{4, 1, 4});
  CHECK(full.steps() == "split fit assess split ");
  SettledNumbers settled({1, 1}, {1, 1});
  settled.settle(100);
  CHECK(settled.steps() == "split ");
}

}  // namespace pharos
