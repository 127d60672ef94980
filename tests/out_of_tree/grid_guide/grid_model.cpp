#include "grid_model.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include <pharos/core/warp.h>

namespace grid_guide {

using namespace pharos;

namespace {

/// The share of directions that are drawn evenly. A histogram of few steps misses light that comes
/// from elsewhere, and such light must not become too bright when it is found.
constexpr double kEven = 0.1;

constexpr float kBinPdf = kBins / (4 * kPi);  // [1/sr] within a bin that is certain

std::uint32_t part_of(float share, std::uint32_t parts) {
  const auto part = static_cast<std::int64_t>(share * static_cast<float>(parts));
  return static_cast<std::uint32_t>(std::clamp<std::int64_t>(part, 0, parts - 1));
}

}  // namespace

std::uint32_t Grid::cell_of(Point3 p) const {
  const Vec3 extent = box.extent();
  std::uint32_t cell = 0;
  for (int axis = 2; axis >= 0; --axis) {
    const float share = extent[axis] > 0 ? (p[axis] - box.low[axis]) / extent[axis] : 0;
    cell = cell * cells + part_of(std::clamp(share, 0.0f, 1.0f), cells);
  }
  return cell;
}

std::uint32_t bin_of(Vec3 direction) {
  const float angle = std::atan2(direction.z, direction.x) / (2 * kPi);
  const std::uint32_t row = part_of(0.5f * (direction.y + 1), kRows);
  return row * kColumns + part_of(angle < 0 ? angle + 1 : angle, kColumns);
}

GridModel::GridModel(Grid grid, const std::vector<CellSums>& sums)
    : grid_(grid),
      cumulative_(sums.size() * kBins),
      evidence_(sums.size()),
      radiance_(sums.size()) {
  for (std::size_t cell = 0; cell < sums.size(); ++cell) {
    const std::vector<double>& radiance = sums[cell].radiance;
    const double total = std::accumulate(radiance.begin(), radiance.end(), 0.0);
    if (!(total > 0)) continue;
    evidence_[cell] = static_cast<float>(sums[cell].steps);
    radiance_[cell] = static_cast<float>(total / (4 * kPi * sums[cell].steps));
    double share = 0;
    for (std::uint32_t bin = 0; bin < kBins; ++bin) {
      share += kEven / kBins + (1 - kEven) * radiance[bin] / total;
      cumulative_[cell * kBins + bin] = static_cast<float>(share);
    }
    cumulative_[cell * kBins + kBins - 1] = 1;
  }
}

ModelInfo GridModel::info() const {
  const auto known =
      std::count_if(evidence_.begin(), evidence_.end(), [](float e) { return e > 0; });
  return {.name = std::string(kName),
          .version = 1,
          .bytes = sizeof *this + (cumulative_.size() + 2 * evidence_.size()) * sizeof(float),
          .regions = std::max(1u, grid_.cell_count()),
          .bounds = grid_.box,
          .facts = {{"cells", fmt::format("{}, {} know something", grid_.cell_count(), known)}}};
}

void GridModel::archive(Archive& archive) {
  archive(grid_.box.low, grid_.box.high, grid_.cells, cumulative_, evidence_, radiance_);
  archive.expect(grid_.cells <= 1024 && evidence_.size() == grid_.cell_count() &&
                     radiance_.size() == evidence_.size() &&
                     cumulative_.size() == evidence_.size() * kBins,
                 "the grid");
}

Place GridModel::place(const GuidingVertex& vertex) const {
  if (evidence_.empty()) return {.evidence = 0};
  const std::uint32_t cell = grid_.cell_of(vertex.position);
  return {.region = cell, .evidence = evidence_[cell]};
}

double GridModel::density(Point3 point, const Vec3* direction) const {
  if (evidence_.empty()) return 0;
  const std::uint32_t cell = grid_.cell_of(point);
  if (direction == nullptr) return radiance_[cell];
  return evidence_[cell] > 0 ? pdf(cell, *direction) : 0;
}

Vec3 GridModel::sample(std::uint32_t cell, Vec2 u) const {
  const auto begin = cumulative_.begin() + static_cast<std::ptrdiff_t>(std::size_t{cell} * kBins);
  const auto found = std::upper_bound(begin, begin + kBins - 1, u.x);
  const auto bin = static_cast<std::uint32_t>(found - begin);
  // The part of the number within the bin serves as another number.
  const float below = bin == 0 ? 0 : share_up_to(cell, bin - 1);
  const float within = std::clamp((u.x - below) / share_of(cell, bin), 0.0f, kOneMinusEpsilon);
  const float y = 2 * (static_cast<float>(bin / kColumns) + u.y) / kRows - 1;
  const float angle = 2 * kPi * (static_cast<float>(bin % kColumns) + within) / kColumns;
  const float radius = std::sqrt(std::max(0.0f, 1 - y * y));
  return {radius * std::cos(angle), y, radius * std::sin(angle)};
}

float GridModel::pdf(std::uint32_t cell, Vec3 direction) const {
  return kBinPdf * share_of(cell, bin_of(direction));
}

}  // namespace grid_guide
