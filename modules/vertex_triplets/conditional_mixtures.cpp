#include "conditional_mixtures.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pharos::vertex_triplets {
namespace {

constexpr float kNever = -std::numeric_limits<float>::infinity();
/// Components with less than 2^-16 of the largest weight are left out.
constexpr float kLeastLog2 = -16;

template <int P>
std::array<float, P> coordinates(const PathPrefix& prefix, Point3 center) {
  std::array<float, P> x;
  for (int axis = 0; axis < 3; ++axis) {
    if constexpr (P == 6) x[axis] = prefix.previous[axis] - center[axis];
    x[P - 3 + axis] = prefix.current[axis] - center[axis];
  }
  return x;
}

}  // namespace

/// The weights of a group given the prefix, and the whitened prefix.
template <int P>
struct ConditionalMixtures<P>::Weighed {
  Weighed() {}  // leaves the members uninitialized, so that arrays of it are not cleared

  std::array<Float8, P> white;
  Float8 log2_weight;
  std::uint32_t run, first_next;
};

template <int P>
void ConditionalMixtures<P>::add_cell(Point3 center, std::span<const Run> runs) {
  Cell cell{center, static_cast<std::uint32_t>(runs_.size()),
            static_cast<std::uint32_t>(runs.size()), 0};
  for (const Run& run : runs) {
    runs_.push_back({run.mode, static_cast<std::uint32_t>(groups_.size()),
                     static_cast<std::uint32_t>(next_.size()),
                     static_cast<std::uint32_t>(run.components.size())});
    for (std::size_t i = 0; i < run.components.size(); ++i) {
      const Component<P>& c = run.components[i];
      if (i % 8 == 0) {
        Group& group = groups_.emplace_back();
        group.mean.fill(Float8{});
        group.factor.fill(Float8{});
        group.log2_weight = all8(kNever);
        ++cell.group_count;
      }
      Group& group = groups_.back();
      const std::size_t lane = i % 8;
      float log2_weight = std::log2(c.weight);
      for (int row = 0; row < P; ++row) {
        group.mean[row][lane] = c.mean[row];
        log2_weight += std::log2(c.factor[triangle(row + 1) - 1]);
      }
      for (int j = 0; j < triangle(P); ++j) group.factor[j][lane] = c.factor[j];
      group.log2_weight[lane] = log2_weight;
      Next& next = next_.emplace_back();
      next.weight = c.weight;
      for (int row = 0, j = triangle(P), l = 0; row < 3; ++row) {
        next.mean[row] = c.mean[P + row];
        for (int column = 0; column < P; ++column) next.gain[row * P + column] = c.factor[j++];
        for (int column = 0; column <= row; ++column) next.cholesky[l++] = c.factor[j++];
      }
    }
  }
  cells_.push_back(cell);
}

template <int P>
auto ConditionalMixtures<P>::runs(std::size_t index) const -> std::vector<Run> {
  const Cell& cell = cells_[index];
  std::vector<Run> result;
  for (std::uint32_t r = cell.first_run; r < cell.first_run + cell.run_count; ++r) {
    const ModeRun& run = runs_[r];
    Run& copy = result.emplace_back(Run{run.mode, {}});
    for (std::uint32_t i = 0; i < run.count; ++i) {
      const Group& group = groups_[run.first_group + i / 8];
      const Next& next = next_[run.first_next + i];
      Component<P>& c = copy.components.emplace_back();
      c.weight = next.weight;
      for (int row = 0; row < P; ++row) c.mean[row] = group.mean[row][i % 8];
      for (int j = 0; j < triangle(P); ++j) c.factor[j] = group.factor[j][i % 8];
      for (int row = 0, j = triangle(P), l = 0; row < 3; ++row) {
        c.mean[P + row] = next.mean[row];
        for (int column = 0; column < P; ++column) c.factor[j++] = next.gain[row * P + column];
        for (int column = 0; column <= row; ++column) c.factor[j++] = next.cholesky[l++];
      }
    }
  }
  return result;
}

template <int P>
std::size_t ConditionalMixtures<P>::size_bytes() const {
  return cells_.size() * sizeof(Cell) + runs_.size() * sizeof(ModeRun) +
         groups_.size() * sizeof(Group) + next_.size() * sizeof(Next);
}

template <int P>
bool ConditionalMixtures<P>::admits(const Mode& mode, const PathPrefix& prefix) const {
  const bool forward = direction_ == Direction::from_sensor;
  const VertexKind known = forward ? mode.before : mode.after;
  const VertexKind wanted = forward ? mode.after : mode.before;
  // Pairs do not depend on the previous vertex.
  if (P == 6 && known != prefix.previous_kind) return false;
  const bool can_be_met = wanted == VertexKind::surface || wanted == VertexKind::volume ||
                          wanted == VertexKind::environment;
  return can_be_met && contains(prefix.events, mode.event);
}

template <int P>
NextVertex ConditionalMixtures<P>::next_of(const Weighed& weighed, int lane, Point3 center) const {
  const ModeRun& run = runs_[weighed.run];
  const Next& next = next_[weighed.first_next + static_cast<std::uint32_t>(lane)];
  NextVertex result;
  result.event = run.mode.event;
  result.kind = direction_ == Direction::from_sensor ? run.mode.after : run.mode.before;
  result.gaussian.weight = weighed.log2_weight[lane];  // given() has made it a share
  for (int row = 0; row < 3; ++row) {
    float mean = next.mean[row];
    for (int column = 0; column < P; ++column) {
      mean += next.gain[row * P + column] * weighed.white[column][lane];
    }
    result.gaussian.mean[row] = center[row] + mean;
  }
  std::copy(next.cholesky.begin(), next.cholesky.end(), result.gaussian.cholesky);
  return result;
}

template <int P>
std::span<const NextVertex> ConditionalMixtures<P>::given(std::size_t index,
                                                          const PathPrefix& prefix,
                                                          Arena& arena) const {
  const Cell& cell = cells_[index];
  if (cell.group_count == 0) return {};
  const std::array<float, P> x = coordinates<P>(prefix, cell.center);
  Weighed* weighed = arena.make_array<Weighed>(cell.group_count);
  std::size_t groups = 0;
  Float8 largest8 = all8(kNever);
  for (std::uint32_t r = cell.first_run; r < cell.first_run + cell.run_count; ++r) {
    const ModeRun& run = runs_[r];
    if (!admits(run.mode, prefix)) continue;
    for (std::uint32_t i = 0; i < run.count; i += 8) {
      const Group& group = groups_[run.first_group + i / 8];
      Weighed& w = weighed[groups++];
      Float8 squared{}, farthest{};
      for (int row = 0; row < P; ++row) {
        const int begin = triangle(row);
        Float8 rest = x[row] - group.mean[row];
        for (int column = 0; column < row; ++column) {
          rest -= group.factor[begin + column] * w.white[column];
        }
        w.white[row] = rest * group.factor[begin + row];
        squared += w.white[row] * w.white[row];
        farthest = larger(farthest, absolute(w.white[row]));
      }
      const Float8 log2_weight = group.log2_weight - (0.5f * kLog2E) * squared;
      w.log2_weight = farthest <= kTruncation ? log2_weight : all8(kNever);
      w.run = r;
      w.first_next = run.first_next + i;
      largest8 = larger(largest8, w.log2_weight);
    }
  }
  float largest = kNever;
  for (int lane = 0; lane < 8; ++lane) largest = std::max(largest, largest8[lane]);
  if (largest == kNever) return {};
  Float8 total8{};
  std::size_t survivors = 0;
  for (std::size_t i = 0; i < groups; ++i) {
    const Float8 below = weighed[i].log2_weight - largest;
    weighed[i].log2_weight = below >= kLeastLog2 ? exp2(below) : Float8{};
    total8 += weighed[i].log2_weight;
    for (int lane = 0; lane < 8; ++lane) survivors += weighed[i].log2_weight[lane] > 0 ? 1 : 0;
  }
  const float to_share = 1 / sum(total8);
  NextVertex* result = arena.make_array<NextVertex>(survivors);
  std::size_t count = 0;
  for (std::size_t i = 0; i < groups; ++i) {
    if (!any(weighed[i].log2_weight > 0)) continue;
    weighed[i].log2_weight *= to_share;
    for (int lane = 0; lane < 8; ++lane) {
      if (weighed[i].log2_weight[lane] > 0) {
        result[count++] = next_of(weighed[i], lane, cell.center);
      }
    }
  }
  return {result, count};
}

template class ConditionalMixtures<3>;
template class ConditionalMixtures<6>;

}  // namespace pharos::vertex_triplets
