#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include <pharos/core/archive.h>
#include <pharos/core/counting_sort.h>
#include <pharos/core/random.h>
#include <pharos/guiding/toolkit/kd_tree.h>

namespace pharos {

/// The rules by which cells are divided and taught. A cell is divided at the mean of its samples'
/// origins, across the axis of their largest variance.
struct CellDivision {
  bool divides = true;
  std::uint32_t cell_samples = 32768;  ///< a cell with more samples is divided
  int max_depth = 32;                  ///< largest number of planes above a cell
  double decay = 0.25;  ///< factor by which each half weights what the cell has learned
  /// Samples also teach neighbors: each goes to the cell at a random point of a box around it. An
  /// even distribution over this box has the variances of the origins in the sample's own cell. In
  /// its first lesson, a cell learns from its own samples alone.
  bool splats = false;
  std::uint64_t seed = 0;  ///< key of these points
};

/// The cells of a kd-tree. Each cell learns from the samples that begin in it, or near it if they
/// are splatted, and cells with many samples are divided. The result is the same for any number of
/// threads.
///
/// `Sample` has a Point3 `origin`. `Cell` is a value with
///
///     bool knows_something() const;
///     void forget(double factor);       // scales the weight of what was learned so far
///     void archive(Archive&);
template <class Sample, class Cell>
class KdTreeCells {
 public:
  /// Divides cells that have too many samples and calls `teach(cell, samples, number)` concurrently
  /// for all cells, with the samples of each. Clears `samples`. A cell that knows nothing learns
  /// before it is divided, because its halves would have fewer samples to learn from.
  template <class Teach>
  void learn(std::vector<Sample>& samples, const CellDivision& rule, Teach&& teach) {
    std::vector<std::size_t> first = sort_by_cell(samples);
    teach_cells(samples, first, true, teach);
    const std::size_t undivided = cells_.size();
    divide_cells(samples, first, rule);
    if (cells_.size() > undivided) tree_.index(box_of(samples));
    if (rule.splats) {
      first = splat(samples, rule.seed);
    } else if (cells_.size() > undivided) {
      first = sort_by_cell(samples);
    }
    teach_cells(samples, first, false, teach);
    for (Place& place : cells_) place.is_done = false;
    samples.clear();
  }

  const KdTree& tree() const { return tree_; }
  std::size_t size() const { return cells_.size(); }
  Cell& operator[](std::size_t i) { return cells_[i].content; }
  const Cell& operator[](std::size_t i) const { return cells_[i].content; }
  bool know_something() const {
    return std::any_of(cells_.begin(), cells_.end(),
                       [](const Place& place) { return place.content.knows_something(); });
  }
  /// Maps each cell to the cell that contained it when mark_origins() was last called; see
  /// Learned::region_origins.
  const std::vector<std::uint32_t>& origins() const { return origins_; }
  void mark_origins() { std::iota(origins_.begin(), origins_.end(), 0u); }

  void archive(Archive& archive);

 private:
  /// Statistics of the origins of a cell's samples.
  struct Positions {
    double count = 0, sums[3] = {}, squares[3] = {};
    void archive(Archive& archive) { archive(count, sums, squares); }

    void add(Point3 p) {
      ++count;
      for (int axis = 0; axis < 3; ++axis) {
        sums[axis] += p[axis];
        squares[axis] += double{p[axis]} * p[axis];
      }
    }
    double variance(int axis) const {
      const double mean = sums[axis] / count;
      return squares[axis] / count - mean * mean;
    }
    int widest_axis() const {
      int widest = 0;
      for (const int axis : {1, 2}) {
        if (variance(axis) > variance(widest)) widest = axis;
      }
      return widest;
    }
  };
  struct Place {
    Cell content;
    Positions positions;   ///< since the cell was last divided
    bool is_done = false;  ///< the cell has learned from the current samples
    void archive(Archive& archive) { archive(content, positions); }
  };
  /// A cell that may be divided.
  struct Candidate {
    std::uint32_t leaf, cell;
    int level;
  };

  static Bounds3 box_of(const std::vector<Sample>& samples) {
    Bounds3 box;
    for (const Sample& sample : samples) box.add(sample.origin);
    return box;
  }

  std::vector<std::size_t> sort_by_cell(std::vector<Sample>& samples) const {
    return sort_by_key(samples, cells_.size(),
                       [&](std::size_t i) { return tree_.cell_at(samples[i].origin); });
  }

  /// Sorts samples as sort_by_cell() does, but by the cells to which they are splatted.
  std::vector<std::size_t> splat(std::vector<Sample>& samples, std::uint64_t seed) const {
    return sort_by_key(samples, cells_.size(), [&](std::size_t i) {
      Point3 p = samples[i].origin;
      const Positions& around = cells_[tree_.cell_at(p)].positions;
      RandomStream random(seed, i);
      for (int axis = 0; axis < 3; ++axis) {
        // An even distribution has the standard deviation edge / sqrt(12).
        const double edge = std::sqrt(12 * std::max(around.variance(axis), 0.0));
        p[axis] += static_cast<float>(edge) * (random.next_1d() - 0.5f);
      }
      return tree_.cell_at(p);
    });
  }

  /// Calls `teach` for the cells that have not yet learned from the current samples. The samples of
  /// cell i begin at index `first[i]`. If `unknowing` is true, only cells that know nothing are
  /// taught.
  template <class Teach>
  void teach_cells(const std::vector<Sample>& samples, const std::vector<std::size_t>& first,
                   bool unknowing, Teach&& teach) {
    parallel_for(cells_.size(), [&](std::size_t i) {
      Place& place = cells_[i];
      if (place.is_done || (unknowing && place.content.knows_something())) return;
      teach(place.content,
            std::span<const Sample>(samples.data() + first[i], first[i + 1] - first[i]), i);
      place.is_done = true;
    });
  }

  void divide_cells(std::vector<Sample>& samples, const std::vector<std::size_t>& first,
                    const CellDivision& rule) {
    const std::vector<std::uint32_t> leaves = tree_.leaves();
    const std::vector<int> levels = tree_.levels();
    for (std::uint32_t cell = 0; cell + 1 < first.size(); ++cell) {
      const std::span<Sample> own(samples.data() + first[cell], first[cell + 1] - first[cell]);
      for (const Sample& s : own) cells_[cell].positions.add(s.origin);
      divide({leaves[cell], cell, levels[leaves[cell]]}, own, rule);
    }
  }

  void divide(Candidate at, std::span<Sample> samples, const CellDivision& rule) {
    const Positions& positions = cells_[at.cell].positions;
    const bool divides = rule.divides && positions.count > rule.cell_samples &&
                         at.level < rule.max_depth && cells_[at.cell].content.knows_something();
    if (!divides) return;
    const int axis = positions.widest_axis();
    const auto plane = static_cast<float>(positions.sums[axis] / positions.count);
    const auto middle = std::stable_partition(
        samples.begin(), samples.end(), [&](const Sample& s) { return s.origin[axis] < plane; });
    // All samples lie on one side of the plane.
    if (middle == samples.begin() || middle == samples.end()) return;
    const KdTree::Halves halves = tree_.divide(at.leaf, axis, plane);
    // A cell that has already learned from these samples forgets everything, because its halves
    // learn from them again.
    cells_[at.cell].content.forget(cells_[at.cell].is_done ? 0 : rule.decay);
    cells_[at.cell].positions = {};
    cells_[at.cell].is_done = false;
    const auto added = static_cast<std::uint32_t>(cells_.size());
    cells_.push_back(cells_[at.cell]);
    origins_.push_back(origins_[at.cell]);
    const std::span<Sample> low(samples.begin(), middle), high(middle, samples.end());
    for (const Sample& s : low) cells_[at.cell].positions.add(s.origin);
    for (const Sample& s : high) cells_[added].positions.add(s.origin);
    divide({halves.low, at.cell, at.level + 1}, low, rule);
    divide({halves.high, added, at.level + 1}, high, rule);
  }

  KdTree tree_;
  std::vector<Place> cells_{1};
  std::vector<std::uint32_t> origins_{0};
};

template <class Sample, class Cell>
void KdTreeCells<Sample, Cell>::archive(Archive& archive) {
  archive(tree_, origins_, cells_);
  const auto expect = [&](bool holds) { archive.expect(holds, "what was learned in cells"); };
  expect(cells_.size() == tree_.cell_count() && origins_.size() == cells_.size());
  for (std::size_t i = 0; i < origins_.size(); ++i) expect(origins_[i] <= i);
}

}  // namespace pharos
