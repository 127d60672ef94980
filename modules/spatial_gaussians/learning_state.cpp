#include "learning_state.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <pharos/core/binary_stream.h>
#include <pharos/core/parallel.h>

namespace pharos::gaussians {
namespace {

constexpr const char* kHeading = "gaussian_learning";
constexpr std::uint32_t kVersion = 1;

/// A scene without extent is taken to be of size one.
double size_of(const Bounds3& region) {
  return region.diagonal() > 0 ? region.diagonal() : 1;
}

}  // namespace

GaussianState::GaussianState(const GaussianSettings& settings, const LearningContext& context)
    : settings_(settings),
      rule_{settings.least_pdf,
            settings.environment_distance * static_cast<float>(size_of(context.region))},
      scene_size_(size_of(context.region)),
      seed_(context.seed) {}

void GaussianState::absorb(const PathLog& log) {
  for (std::size_t i = 0; i < log.size(); ++i) {
    extract_samples(log[i], rule_, incident_, samples_);
  }
  if (samples_.size() >= settings_.batch_samples) learn();
}

std::shared_ptr<const GuidingModel> GaussianState::update(std::uint32_t, bool) {
  learn();
  const bool knows_something = std::any_of(cells_.begin(), cells_.end(), [](const Cell& cell) {
    return cell.mixture.knows_something();
  });
  if (!knows_something) return nullptr;
  auto learned = model();
  std::iota(origins_.begin(), origins_.end(), 0u);
  for (Cell& cell : cells_) cell.mixture.forget(settings_.decay);
  return learned;
}

void GaussianState::learn() {
  std::vector<std::size_t> first = sort_by_cell();
  update_cells(first, true);
  const std::size_t undivided = cells_.size();
  divide_cells(first);
  if (cells_.size() > undivided) first = sort_by_cell();
  update_cells(first, false);
  for (Cell& cell : cells_) cell.is_done = false;
  samples_.clear();
  ++lessons_;
}

void GaussianState::update_cells(const std::vector<std::size_t>& first, bool unknowing) {
  parallel_for(cells_.size(), [&](std::size_t cell) {
    CellMixture& mixture = cells_[cell].mixture;
    if (cells_[cell].is_done || (unknowing && mixture.knows_something())) return;
    const std::span<const Sample> samples(samples_.data() + first[cell],
                                          first[cell + 1] - first[cell]);
    mixture.update(samples, settings_, scene_size_, RandomStream(seed_, lessons_, cell));
    cells_[cell].is_done = true;
  });
}

std::vector<std::size_t> GaussianState::sort_by_cell() {
  std::vector<std::uint32_t> cell_of(samples_.size());
  parallel_for(samples_.size(),
               [&](std::size_t i) { cell_of[i] = tree_.cell_at(samples_[i].origin); });
  std::vector<std::size_t> first(cells_.size() + 1, 0);
  for (const std::uint32_t cell : cell_of) ++first[cell + 1];
  for (std::size_t cell = 0; cell < cells_.size(); ++cell) first[cell + 1] += first[cell];
  std::vector<std::size_t> next(first.begin(), first.end() - 1);
  std::vector<Sample> sorted(samples_.size());
  for (std::size_t i = 0; i < samples_.size(); ++i) sorted[next[cell_of[i]]++] = samples_[i];
  samples_ = std::move(sorted);
  return first;
}

void GaussianState::Positions::add(Point3 p) {
  ++count;
  for (int axis = 0; axis < 3; ++axis) {
    sums[axis] += p[axis];
    squares[axis] += double{p[axis]} * p[axis];
  }
}

int GaussianState::Positions::widest_axis() const {
  const auto variance = [&](int axis) {
    const double mean = sums[axis] / count;
    return squares[axis] / count - mean * mean;
  };
  int widest = 0;
  for (const int axis : {1, 2}) {
    if (variance(axis) > variance(widest)) widest = axis;
  }
  return widest;
}

void GaussianState::divide_cells(const std::vector<std::size_t>& first) {
  const std::vector<std::uint32_t> leaves = tree_.leaves();
  const std::vector<int> levels = tree_.levels();
  for (std::uint32_t cell = 0; cell + 1 < first.size(); ++cell) {
    const std::span<Sample> samples(samples_.data() + first[cell], first[cell + 1] - first[cell]);
    for (const Sample& s : samples) cells_[cell].positions.add(s.origin);
    divide({leaves[cell], cell, levels[leaves[cell]]}, samples);
  }
}

void GaussianState::divide(Place place, std::span<Sample> samples) {
  const Positions& positions = cells_[place.cell].positions;
  const bool divides =
      settings_.spatial == SpatialCells::kdtree && positions.count > settings_.cell_samples &&
      place.level < settings_.max_depth && cells_[place.cell].mixture.knows_something();
  if (!divides) return;
  const int axis = positions.widest_axis();
  const auto plane = static_cast<float>(positions.sums[axis] / positions.count);
  const auto middle = std::stable_partition(
      samples.begin(), samples.end(), [&](const Sample& s) { return s.origin[axis] < plane; });
  if (middle == samples.begin() || middle == samples.end()) return;  // all in one place
  const KdTree::Halves halves = tree_.divide(place.leaf, axis, plane);
  cells_[place.cell].mixture.forget(settings_.division_decay);
  cells_[place.cell].positions = {};
  cells_[place.cell].is_done = false;
  const auto added = static_cast<std::uint32_t>(cells_.size());
  cells_.push_back(cells_[place.cell]);
  origins_.push_back(origins_[place.cell]);
  const std::span<Sample> low(samples.begin(), middle), high(middle, samples.end());
  for (const Sample& s : low) cells_[place.cell].positions.add(s.origin);
  for (const Sample& s : high) cells_[added].positions.add(s.origin);
  divide({halves.low, place.cell, place.level + 1}, low);
  divide({halves.high, added, place.level + 1}, high);
}

std::shared_ptr<const GuidingModel> GaussianState::model() const {
  std::vector<GaussianModel::Cell> cells;
  for (const Cell& cell : cells_) {
    cells.push_back({cell.mixture.components(), static_cast<float>(cell.mixture.samples())});
  }
  return std::make_shared<GaussianModel>(tree_, cells, origins_);
}

void GaussianState::save(std::ostream& out) const {
  save_heading(out, kHeading, kVersion);
  tree_.save(out);
  save_number(out, lessons_);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const Cell& cell = cells_[i];
    save_number(out, origins_[i]);
    cell.mixture.save(out);
    save_number(out, cell.positions.count);
    for (int axis = 0; axis < 3; ++axis) {
      save_number(out, cell.positions.sums[axis]);
      save_number(out, cell.positions.squares[axis]);
    }
  }
  save_number(out, static_cast<std::uint64_t>(samples_.size()));
  for (const Sample& sample : samples_) save_sample(sample, out);
}

void GaussianState::load(std::istream& in) {
  GaussianState loaded(*this);
  loaded.read(in);
  *this = std::move(loaded);
}

void GaussianState::read(std::istream& in) {
  expect_heading(in, kHeading, kVersion);
  tree_ = KdTree::load(in);
  lessons_ = load_number<std::uint64_t>(in);
  cells_.clear();
  origins_.clear();
  while (cells_.size() < tree_.cell_count()) {
    Cell& cell = cells_.emplace_back();
    origins_.push_back(load_number<std::uint32_t>(in));
    if (origins_.back() >= cells_.size()) {
      throw InputError("the learning of the Gaussians is damaged");
    }
    cell.mixture = CellMixture::load(in);
    cell.positions.count = load_finite<double>(in);
    for (int axis = 0; axis < 3; ++axis) {
      cell.positions.sums[axis] = load_finite<double>(in);
      cell.positions.squares[axis] = load_finite<double>(in);
    }
  }
  samples_.clear();
  for (auto count = load_number<std::uint64_t>(in); count > 0; --count) {
    samples_.push_back(load_sample(in));
  }
}

void GaussianState::merge(const LearningState& other) {
  const auto& theirs = dynamic_cast<const GaussianState&>(other);
  if (theirs.tree_ != tree_ || theirs.lessons_ != lessons_) {
    throw InputError(
        "learning of Gaussians in another iteration or scene, or after more than `batch_samples`, "
        "cannot be merged");
  }
  samples_.insert(samples_.end(), theirs.samples_.begin(), theirs.samples_.end());
}

}  // namespace pharos::gaussians
