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
  Float8 squared;  ///< sum of the squares of `white`
  Float8 log2_weight;
  std::uint32_t run, group;
};

template <int P>
std::size_t ConditionalMixtures<P>::add_group() {
  Group& group = groups_.emplace_back();
  group.mean.fill(Float8{});
  group.factor.fill(Float8{});
  group.log2_weight = all8(kNever);
  NextPart& next = next_parts_.emplace_back();
  next.weight = Float8{};
  next.mean.fill(Float8{});
  next.gain.fill(Float8{});
  for (int i = 0; i < 6; ++i) next.cholesky[i] = all8(SpatialGaussian{}.cholesky[i]);
  return groups_.size() - 1;
}

template <int P>
void ConditionalMixtures<P>::add_cell(Point3 center, std::span<const Run> runs) {
  Cell cell{center, static_cast<std::uint32_t>(runs_.size()),
            static_cast<std::uint32_t>(runs.size()), 0};
  for (const Run& run : runs) {
    runs_.push_back({run.mode, static_cast<std::uint32_t>(groups_.size()),
                     static_cast<std::uint32_t>(run.components.size())});
    cell.group_count += runs_.back().group_count();
    component_count_ += run.components.size();
    for (std::size_t i = 0; i < run.components.size(); ++i) {
      const Component<P>& c = run.components[i];
      const std::size_t lane = i % 8;
      const std::size_t index = lane == 0 ? add_group() : groups_.size() - 1;
      Group& group = groups_[index];
      float log2_weight = std::log2(c.weight);
      for (int row = 0; row < P; ++row) {
        group.mean[row][lane] = c.mean[row];
        log2_weight += std::log2(c.factor[triangle(row + 1) - 1]);
      }
      for (int j = 0; j < triangle(P); ++j) group.factor[j][lane] = c.factor[j];
      group.log2_weight[lane] = log2_weight;
      NextPart& next = next_parts_[index];
      next.weight[lane] = c.weight;
      for (int row = 0, j = triangle(P), l = 0; row < 3; ++row) {
        next.mean[row][lane] = c.mean[P + row];
        for (int column = 0; column < P; ++column) {
          next.gain[row * P + column][lane] = c.factor[j++];
        }
        for (int column = 0; column <= row; ++column) next.cholesky[l++][lane] = c.factor[j++];
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
      const std::uint32_t lane = i % 8;
      const Group& group = groups_[run.first_group + i / 8];
      const NextPart& next = next_parts_[run.first_group + i / 8];
      Component<P>& c = copy.components.emplace_back();
      c.weight = next.weight[lane];
      for (int row = 0; row < P; ++row) c.mean[row] = group.mean[row][lane];
      for (int j = 0; j < triangle(P); ++j) c.factor[j] = group.factor[j][lane];
      for (int row = 0, j = triangle(P), l = 0; row < 3; ++row) {
        c.mean[P + row] = next.mean[row][lane];
        for (int column = 0; column < P; ++column) {
          c.factor[j++] = next.gain[row * P + column][lane];
        }
        for (int column = 0; column <= row; ++column) c.factor[j++] = next.cholesky[l++][lane];
      }
    }
  }
  return result;
}

template <int P>
std::size_t ConditionalMixtures<P>::size_bytes() const {
  return cells_.size() * sizeof(Cell) + runs_.size() * sizeof(ModeRun) +
         groups_.size() * (sizeof(Group) + sizeof(NextPart));
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
void ConditionalMixtures<P>::weigh(const Group& group, const std::array<float, P>& prefix,
                                   Weighed& weighed) const {
  Float8 farthest{};
  weighed.squared = Float8{};
  for (int row = 0; row < P; ++row) {
    const int begin = triangle(row);
    Float8 rest = prefix[row] - group.mean[row];
    for (int column = 0; column < row; ++column) {
      rest -= group.factor[begin + column] * weighed.white[column];
    }
    weighed.white[row] = rest * group.factor[begin + row];
    weighed.squared += weighed.white[row] * weighed.white[row];
    farthest = larger(farthest, absolute(weighed.white[row]));
  }
  const Float8 log2_weight = group.log2_weight - (0.5f * kLog2E) * weighed.squared;
  weighed.log2_weight = farthest <= kTruncation ? log2_weight : all8(kNever);
}

/// Fills in the Gaussians of the next vertex (eq. 18).
template <int P>
void ConditionalMixtures<P>::fill_next(const Weighed& weighed, Point3 center,
                                       NextGroup& next) const {
  const NextPart& part = next_parts_[weighed.group];
  Float8 mean[3];
  for (int row = 0; row < 3; ++row) {
    mean[row] = part.mean[row];
    for (int column = 0; column < P; ++column) {
      mean[row] += part.gain[row * P + column] * weighed.white[column];
    }
  }
  next.mean = {center.x + mean[0], center.y + mean[1], center.z + mean[2]};
  std::copy(part.cholesky.begin(), part.cholesky.end(), next.cholesky);
  const Mode& mode = runs_[weighed.run].mode;
  next.event = mode.event;
  next.kind = direction_ == Direction::from_sensor ? mode.after : mode.before;
}

template <int P>
std::span<const NextGroup> ConditionalMixtures<P>::given(std::size_t index,
                                                         const PathPrefix& prefix,
                                                         Arena& arena) const {
  const Cell& cell = cells_[index];
  if (cell.group_count == 0) return {};
  const std::array<float, P> x = coordinates<P>(prefix, cell.center);
  Weighed* weighed = arena.make_array<Weighed>(cell.group_count);
  std::size_t count = 0;
  Float8 largest8 = all8(kNever);
  Mask8 is_near{};
  // No distance is larger than the truncation, except by rounding.
  const float most_squared = prefix.most_deviations < kTruncation
                                 ? P * square(prefix.most_deviations)
                                 : std::numeric_limits<float>::infinity();
  for (std::uint32_t r = cell.first_run; r < cell.first_run + cell.run_count; ++r) {
    const ModeRun& run = runs_[r];
    if (!admits(run.mode, prefix)) continue;
    for (std::uint32_t g = run.first_group; g < run.first_group + run.group_count(); ++g) {
      Weighed& w = weighed[count++];
      w.run = r;
      w.group = g;
      weigh(groups_[g], x, w);
      largest8 = larger(largest8, w.log2_weight);
      is_near |= (w.log2_weight > kNever) & (w.squared <= most_squared);
    }
  }
  float largest = kNever;
  for (int lane = 0; lane < 8; ++lane) largest = std::max(largest, largest8[lane]);
  if (largest == kNever || !any(is_near)) return {};
  NextGroup* result = arena.make_array<NextGroup>(count);
  std::size_t survivors = 0;
  Float8 total{};
  for (std::size_t i = 0; i < count; ++i) {
    const Mask8 matters = weighed[i].log2_weight - largest >= kLeastLog2;
    if (!any(matters)) continue;
    NextGroup& next = result[survivors++];
    next.share = matters ? exp2(weighed[i].log2_weight - largest) : Float8{};
    total += next.share;
    fill_next(weighed[i], cell.center, next);
  }
  const float to_share = 1 / sum(total);
  for (std::size_t i = 0; i < survivors; ++i) result[i].share *= to_share;
  return {result, survivors};
}

template class ConditionalMixtures<3>;
template class ConditionalMixtures<6>;

}  // namespace pharos::vertex_triplets
