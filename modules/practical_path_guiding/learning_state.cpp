#include "learning_state.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include <pharos/core/counting_sort.h>

#include "model.h"

namespace pharos::practical_path_guiding {
namespace {

/// Returns a cube that contains the scene and has the same lowest corner. If the scene has no
/// extent, the edge of the cube is one.
Bounds3 cube_around(const Bounds3& region) {
  const Vec3 extent = region.high - region.low;
  const float size = std::max({extent.x, extent.y, extent.z});
  Bounds3 cube;
  cube.add(region.low);
  const float edge = size > 0 ? size : 1;
  cube.add(region.low + Vec3{edge, edge, edge});
  return cube;
}

/// Returns both halves of a box.
std::array<Bounds3, 2> halves(const Bounds3& box, int axis) {
  std::array<Bounds3, 2> parts{box, box};
  parts[0].high[axis] = parts[1].low[axis] = 0.5f * (box.low[axis] + box.high[axis]);
  return parts;
}

/// Returns the contribution of the whole path to its pixel, mean of the channels.
double value_of(const PathView& path, const std::vector<Rgb>& incident) {
  const RecordedVertex& lens = path.vertices[0];
  return mean(lens.throughput * lens.local_weight * incident[0]);
}

}  // namespace

PracticalPathGuidingLearningState::PracticalPathGuidingLearningState(
    const PracticalPathGuidingSettings& settings, const LearningContext& context)
    : settings_(settings),
      seed_(context.seed),
      film_pixels_(static_cast<double>(context.window.area())),
      cube_(cube_around(context.region)),
      division_{.space = {}, .by_facing = settings.by_facing},
      cells_(division_.count(), {.box = cube_, .sums = {.tree = QuadTree(refinement())}}),
      origins_(division_.count(), 0),
      pixels_(settings.target == GuidingTarget::relative ? context.window : PixelRect{}) {}

void PracticalPathGuidingLearningState::absorb(const PathLog& log) {
  for (std::size_t i = 0; i < log.size(); ++i) {
    const PathView path = log[i];
    if (path.transport != Transport::radiance) continue;
    extract_records(path, settings_.target, settings_.light_hits, pixels_, incident_, records_);
    ++paths_;
    if (settings_.target != GuidingTarget::relative) continue;
    const double value = value_of(path, incident_);
    if (std::isfinite(value)) pixels_.add(path.film, value);
  }
  if (records_.size() >= settings_.batch_records) flush();
}

std::uint32_t PracticalPathGuidingLearningState::cell_for(const Record& record,
                                                          RandomStream random) const {
  const std::uint32_t own = division_.at(record.position, record.facing);
  if (settings_.spatial_filter == SpatialFilter::nearest) return own;
  const Bounds3& box = cells_[own].box;
  Point3 p = record.position;
  for (int axis = 0; axis < 3; ++axis) {
    p[axis] += (random.next_1d() - 0.5f) * (box.high[axis] - box.low[axis]);
  }
  return division_.at(p, record.facing);
}

void PracticalPathGuidingLearningState::flush() {
  const std::vector<std::size_t> first = sort_by_key(records_, cells_.size(), [&](std::size_t i) {
    return cell_for(records_[i], RandomStream(seed_, batches_, i));
  });
  parallel_for(cells_.size(), [&](std::size_t i) {
    Cell& cell = cells_[i];
    for (std::size_t k = first[i]; k < first[i + 1]; ++k) {
      const Record& record = records_[k];
      ++cell.records;
      ++cell.sums.weight;
      cell.sums.steps += record.steps;
      if (record.value == 0) continue;
      cell.sums.light += record.value;
      cell.sums.squares += double{record.value} * record.value;
      if (settings_.directional_filter == DirectionalFilter::box) {
        cell.sums.tree.spread(record.direction, record.value);
      } else {
        cell.sums.tree.add(record.direction, record.value);
      }
    }
  });
  records_.clear();
  ++batches_;
}

Learned PracticalPathGuidingLearningState::update(const TrainingStage&) {
  flush();
  const double samples = paths_ / film_pixels_;  // per pixel
  // c sqrt(2^k) of the paper for iterations of 4 * 2^k samples per pixel, as in the published code.
  const double threshold = settings_.spatial_threshold * std::sqrt(samples / 4);
  conclude();
  const std::vector<std::uint32_t> leaves = division_.space.leaves();
  for (std::uint32_t cell = 0; cell < leaves.size(); ++cell) {
    halve(leaves[cell], cell, threshold);
  }
  division_.space.index(cube_);
  const bool knows_something = std::any_of(cells_.begin(), cells_.end(),
                                           [](const Cell& cell) { return !cell.known.empty(); });
  Learned learned;
  if (knows_something) {
    learned = {model(), origins_};
    std::iota(origins_.begin(), origins_.end(), 0u);
  }
  for (Cell& cell : cells_) cell.records = 0;
  pixels_.update(settings_.pixel_radius, settings_.least_pixel);
  paths_ = 0;
  return learned;
}

void PracticalPathGuidingLearningState::conclude() {
  if (settings_.spatial_prior == 0) {
    parallel_for(cells_.size(), [&](std::size_t i) { conclude(cells_[i], cells_[i].sums); });
    return;
  }
  std::vector<const Sums*> own;
  for (const Cell& cell : cells_) own.push_back(&cell.sums);
  const std::vector<Sums> seen =
      with_larger_cells(own, division_, settings_.spatial_prior, leaf_mass(), refinement());
  parallel_for(cells_.size(), [&](std::size_t i) { conclude(cells_[i], seen[i]); });
}

void PracticalPathGuidingLearningState::conclude(Cell& cell, const Sums& seen) const {
  if (seen.light > 0) {
    std::optional<QuadTree> smoothed;
    if (settings_.directional_prior > 0 && seen.effective() > 0) {
      const double value = seen.light / seen.effective();  // of an effective record
      smoothed = seen.tree.smoothed(settings_.directional_prior * value);
    }
    const QuadTree& tree = smoothed ? *smoothed : seen.tree;
    cell.known = tree.density(leaf_mass());
    cell.known_light = static_cast<float>(seen.mean());
    cell.known_records = static_cast<float>(seen.weight);
    QuadTree refined = tree.refined(leaf_mass(), refinement());
    if (settings_.memory > 0) refined.add(cell.sums.tree, settings_.memory, false);
    cell.sums.tree = std::move(refined);
  }
  cell.sums.light *= settings_.memory;
  cell.sums.squares *= settings_.memory;
  cell.sums.weight *= settings_.memory;
  cell.sums.steps *= settings_.memory;
}

void PracticalPathGuidingLearningState::halve(std::uint32_t leaf, std::uint32_t cell,
                                              double threshold) {
  double records = 0;
  for (const Cell& part : cells_in(cell)) records += part.records;
  const int level = cells_in(cell).front().level;
  if (!(records > threshold) || level >= settings_.spatial_depth) return;
  const int axis = level % 3;
  const std::array<Bounds3, 2> parts = halves(cells_in(cell).front().box, axis);
  const std::uint32_t added = division_.space.cell_count();
  const KdTree::Halves places = division_.space.divide(leaf, axis, parts[1].low[axis]);
  for (std::uint32_t i = 0; i < division_.in_each(); ++i) {
    const std::uint32_t low = cell * division_.in_each() + i;
    cells_[low].halve();
    cells_.push_back(cells_[low]);
    origins_.push_back(origins_[low]);
    cells_[low].box = parts[0];
    cells_.back().box = parts[1];
  }
  halve(places.low, cell, threshold);
  halve(places.high, added, threshold);
}

std::shared_ptr<const GuidingModel> PracticalPathGuidingLearningState::model() const {
  std::vector<PracticalPathGuidingModel::Cell> cells;
  for (const Cell& cell : cells_) {
    cells.push_back({cell.known, cell.known_light, cell.known_records});
  }
  return std::make_shared<PracticalPathGuidingModel>(division_, cells,
                                                     settings_.target == GuidingTarget::radiance);
}

void PracticalPathGuidingLearningState::archive(Archive& archive) {
  archive.heading("practical_path_guiding_learning", 7);
  archive(division_, origins_, pixels_, batches_, paths_, records_);
  archive.list(cells_, [&] { return Cell{.box = {}, .sums = {.tree = QuadTree(refinement())}}; });
  if (!archive.loads()) return;
  const auto expect = [&](bool holds) { archive.expect(holds, "the learning of the SD-tree"); };
  expect(cells_.size() == division_.count() && origins_.size() == cells_.size());
  const std::vector<std::uint32_t> leaves = division_.space.leaves();
  const std::vector<int> levels = division_.space.levels();
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const Cell& cell = cells_[i];
    expect(origins_[i] <= i && cell.level == levels[leaves[i / division_.in_each()]] &&
           !cell.box.empty() && is_density(cell.known) && cell.records >= 0 &&
           cell.known_light >= 0 && cell.known_records >= 0);
  }
}

}  // namespace pharos::practical_path_guiding
