#include "learning_state.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "model.h"

namespace pharos::focal {
namespace {

/// The number of segments in a group, and the number of groups that are splatted at a time. Each
/// group has its own sums.
constexpr std::size_t kGroup = 4096, kGroups = 16;

/// Returns the region as a box with a volume. A flat region gets a thousandth of its diagonal as
/// thickness.
Box region_box(const Bounds3& region) {
  Box box{{-0.5, -0.5, -0.5}, {1, 1, 1}};
  if (region.empty()) return box;
  const double least = region.diagonal() > 0 ? 1e-3 * region.diagonal() : 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double extent = double{region.high[axis]} - region.low[axis];
    box.size[axis] = std::max(extent, least);
    box.low[axis] = region.low[axis] - 0.5 * (box.size[axis] - extent);
  }
  return box;
}

Bounds3 region_of(const FocalSettings& settings, const LearningContext& context) {
  if (!settings.region) return context.region;
  Bounds3 region;
  region.add(settings.region->low);
  region.add(settings.region->high);
  return region;
}

double diagonal(const Box& box) {
  double squared = 0;
  for (const double size : box.size) squared += size * size;
  return std::sqrt(squared);
}

/// Multiplies masses by `decay` and adds the new sums divided by the number of paths.
void fold(std::vector<double>& masses, const std::vector<double>& sums, double decay,
          double paths) {
  for (std::size_t i = 0; i < masses.size(); ++i) {
    masses[i] = decay * masses[i] + sums[i] / paths;
  }
}

}  // namespace

FocalLearningState::FocalLearningState(const FocalSettings& settings,
                                       const LearningContext& context)
    : settings_(settings),
      max_depth_(settings.max_depth),
      growths_left_(settings.region_growths),
      seed_(context.seed),
      sums_(density_),
      kept_(settings.kept_segments) {
  const Box box = region_box(region_of(settings, context));
  diagonal_ = diagonal(box);
  // Learning starts with the uniform density in both octrees. Each is refined as if it had all
  // mass.
  converging_ = diverging_ =
      refined(uniform_octree(box, 0.5),
              {.threshold = settings.split_threshold / 2, .max_depth = max_depth_});
  use_octrees();
}

bool FocalLearningState::next_narrows(const TrainingStage& stage) const {
  if (settings_.burn_in) {
    return stage.iteration + 1 >= static_cast<std::uint32_t>(*settings_.burn_in);
  }
  const std::uint32_t iterations = stage.iteration + 1 + stage.left;
  return narrowing_ ||
         stage.left <=
             std::min(iterations / 3, static_cast<std::uint32_t>(settings_.narrowing_iterations));
}

void FocalLearningState::absorb(const PathLog& log) {
  const ExtentRule rule{settings_.splat_extent, settings_.glossy_roughness};
  for (std::size_t i = 0; i < log.size(); ++i) {
    if (log[i].transport != Transport::radiance) continue;
    ++paths_;
    extract_segments(log[i], rule, incident_, waiting_);
    if (waiting_.size() >= kGroup * kGroups) splat_waiting();
  }
}

void FocalLearningState::splat_in_groups(std::span<const Segment> segments, Splat splat) {
  while (!segments.empty()) {
    const auto batch = segments.first(std::min(segments.size(), kGroup * kGroups));
    segments = segments.subspan(batch.size());
    groups_.assign((batch.size() + kGroup - 1) / kGroup, FocalSums(density_));
    // The loop is isolated, because the thread that waits here must not take up rendering instead.
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_for(std::size_t{0}, groups_.size(), [&](std::size_t g) {
        const std::size_t begin = g * kGroup;
        (this->*splat)(batch.subspan(begin, std::min(kGroup, batch.size() - begin)), groups_[g]);
      });
    });
    for (const FocalSums& group : groups_) sums_.add(group);
  }
}

void FocalLearningState::splat_by_cell(std::span<const Segment> segments) {
  std::vector<std::vector<Segment>> by_cell(grid_.count());
  for (const Segment& segment : segments) by_cell[grid_.at(segment.origin)].push_back(segment);
  new_uses_.resize(by_cell.size());
  // Each group has every kGroups-th cell, so the sums do not depend on the number of threads.
  groups_.assign(std::min(kGroups, by_cell.size()), FocalSums(density_));
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(std::size_t{0}, groups_.size(), [&](std::size_t g) {
      for (std::size_t cell = g; cell < by_cell.size(); cell += kGroups) {
        if (by_cell[cell].empty()) continue;
        FocalSums sums(density_);
        splat_narrowed(by_cell[cell], density_in(cell), settings_.mis_compensation, sums);
        new_uses_[cell].add(by_cell[cell], density_, sums);
        groups_[g].add(sums);
      }
    });
  });
  for (const FocalSums& group : groups_) sums_.add(group);
}

void FocalLearningState::splat_waiting() {
  if (narrowing_ && settings_.local_cells > 1) {
    splat_by_cell(waiting_);
  } else {
    splat_in_groups(waiting_, &FocalLearningState::splat_new);
  }
  splatted_ += waiting_.size();
  if (settings_.catch_up > 0) {
    RandomStream random(seed_, batches_++);
    for (const Segment& segment : waiting_) {
      const double contribution = segment.contribution;
      kept_.insert(segment, contribution, random);
      squares_ += contribution * contribution;
    }
  }
  waiting_.clear();
}

void FocalLearningState::splat_new(std::span<const Segment> segments, FocalSums& sums) const {
  if (narrowing_) {
    splat_narrowed(segments, density_, settings_.mis_compensation, sums);
  } else {
    const double unit = settings_.splat_weight == SplatWeight::length ? diagonal_ : 0.0;
    splat_lengths(segments, density_, unit, sums);
  }
}

void FocalLearningState::splat_kept(std::span<const Segment> segments, FocalSums& sums) const {
  splat_again(segments, density_, settings_.mis_compensation, settings_.caught_up_share, sums);
}

Learned FocalLearningState::update(const TrainingStage& stage) {
  splat_waiting();
  // If an iteration finds no light, the masses of earlier iterations stay.
  if (sums_.total() > 0) {
    double decay = narrowing_ ? settings_.narrowing_decay : settings_.decay;
    if (!knows_something_) decay = 0;
    segments_ = decay * segments_ + static_cast<double>(splatted_);
    learn_sums(decay);
    if (growths_left_ > 0 && !next_narrows(stage)) grow_region();
    knows_something_ = true;
  }
  if (settings_.catch_up > 0 && next_narrows(stage)) catch_up();
  // Only a learned density can be narrowed.
  narrowing_ = knows_something_ && next_narrows(stage);
  paths_ = splatted_ = 0;
  kept_ = statistics::VarOptReservoir<Segment>(kept_.capacity());
  squares_ = 0;
  learn_uses();
  return {knows_something_ ? model(stage.is_last()) : nullptr};
}

void FocalLearningState::learn_sums(double decay) {
  fold(converging_.masses, sums_.converging, decay, static_cast<double>(paths_));
  fold(diverging_.masses, sums_.diverging, decay, static_cast<double>(paths_));
  refine();
}

bool FocalLearningState::has_enough_light() const {
  // Kish's effective size: the number of equal contributions with the same uncertainty.
  const double sum = kept_.total_weight();
  return squares_ > 0 && sum * sum >= settings_.least_segments * squares_;
}

void FocalLearningState::catch_up() {
  if (!has_enough_light()) {
    missed_ = std::min(missed_ + 1, settings_.catch_up);
    return;
  }
  std::vector<Segment> segments;
  kept_.for_each([&](Segment segment, double weight) {
    segment.contribution = static_cast<float>(weight);
    segments.push_back(segment);
  });
  for (; missed_ > 0; --missed_) {
    splat_in_groups(segments, &FocalLearningState::splat_kept);
    // The segments may lie where the density is zero.
    if (!(sums_.total() > 0)) return;
    learn_sums(0);
  }
}

void FocalLearningState::refine() {
  const double mass = converging_.mass() + diverging_.mass();
  const SplitRule rule{settings_.split_threshold, max_depth_, mass};
  converging_ = refined(converging_, rule);
  diverging_ = refined(diverging_, rule);
  use_octrees();
}

void FocalLearningState::use_octrees() {
  density_ = {converging_.octree, diverging_.octree};
  sums_ = FocalSums(density_);
  grid_ = CellGrid(density_.converging.box(), settings_.local_cells);
  local_.clear();
}

void FocalLearningState::learn_uses() {
  uses_.resize(std::max(uses_.size(), new_uses_.size()));
  for (std::size_t cell = 0; cell < new_uses_.size(); ++cell) uses_[cell] += new_uses_[cell];
  new_uses_.clear();
  use_local_densities();
}

void FocalLearningState::use_local_densities() {
  if (uses_.empty()) return;
  local_.resize(uses_.size());
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(std::size_t{0}, uses_.size(), [&](std::size_t cell) {
      local_[cell] = local_density(density_, uses_[cell], settings_.local_prior);
    });
  });
}

void FocalLearningState::grow_region() {
  const bool is_at_boundary =
      is_densest_at_boundary(density_.converging) || is_densest_at_boundary(density_.diverging);
  if (!is_at_boundary || max_depth_ + 1 >= Octree::kMostLevels) return;
  converging_ = enlarged(converging_);
  diverging_ = enlarged(diverging_);
  ++max_depth_;  // keeps the size of the smallest cells
  --growths_left_;
  refine();
}

std::shared_ptr<const GuidingModel> FocalLearningState::model(bool last) const {
  const auto finished = [&](const FocalDensity& density) {
    if (!last || settings_.prune_ratio == 0) return density;
    return FocalDensity{pruned(density.converging, settings_.prune_ratio),
                        pruned(density.diverging, settings_.prune_ratio)};
  };
  std::vector<FocalDensity> local;
  local.reserve(local_.size());
  for (const FocalDensity& density : local_) local.push_back(finished(density));
  return std::make_shared<FocalModel>(finished(density_), static_cast<float>(segments_),
                                      std::move(local), settings_.local_cells);
}

void FocalLearningState::archive(Archive& archive) {
  const auto expect = [&](bool holds) {
    archive.expect(holds, "what was learned of focal points");
  };
  archive.heading("focal_learning", 5);
  archive(converging_, diverging_, knows_something_, narrowing_, max_depth_, growths_left_, paths_,
          segments_, splatted_, missed_, batches_, kept_, squares_, uses_, new_uses_);
  expect(converging_.octree.box() == diverging_.octree.box() && max_depth_ >= 0 &&
         max_depth_ < Octree::kMostLevels && segments_ >= 0 && squares_ >= 0 && missed_ >= 0 &&
         missed_ <= settings_.catch_up);
  if (archive.loads()) {
    use_octrees();
    for (const auto* uses : {&uses_, &new_uses_}) {
      expect(uses->empty() || uses->size() == grid_.count());
    }
    use_local_densities();
  }
  archive(sums_.converging, sums_.diverging, waiting_);
  expect(sums_.converging.size() == converging_.masses.size() &&
         sums_.diverging.size() == diverging_.masses.size());
  for (const auto* sums : {&sums_.converging, &sums_.diverging}) {
    for (const double sum : *sums) expect(sum >= 0);
  }
}

}  // namespace pharos::focal
