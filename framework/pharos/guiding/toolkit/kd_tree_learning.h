#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <pharos/config/schema.h>
#include <pharos/core/error.h>
#include <pharos/guiding/contract/learner.h>
#include <pharos/guiding/toolkit/kd_tree_cells.h>

namespace pharos {

/// The regions for which mixtures are learned.
enum class SpatialCells {
  kdtree,  ///< one mixture for each cell of a growing tree
  single   ///< one mixture for the whole scene
};
template <>
struct EnumNames<SpatialCells> {
  static constexpr auto names = std::to_array<EnumName<SpatialCells>>(
      {{"kdtree", SpatialCells::kdtree}, {"single", SpatialCells::single}});
};

/// The learning state of methods that learn in the cells of a kd-tree (KdTreeCells). Samples are
/// collected until the end of an iteration, or until there are `batch_samples` of them.
///
/// `Lessons` is a value that defines how the method learns:
///
///     using Sample = …;  using Cell = …;    // as in KdTreeCells; samples also have archive()
///     static constexpr const char* kHeading;  static constexpr std::uint32_t kVersion;
///     const Settings& settings() const;     // with spatial, cell_samples, max_depth,
///                                           // batch_samples, decay, division_decay, splat
///     std::uint64_t seed() const;
///     void extract(const PathView&, std::vector<Sample>& samples);
///     void teach(Cell&, std::span<const Sample>, std::uint64_t lesson, std::size_t cell) const;
///     std::shared_ptr<const GuidingModel> model(const KdTreeCells<Sample, Cell>&) const;
template <class Lessons>
class KdTreeLearning final : public LearningState {
 public:
  explicit KdTreeLearning(Lessons lessons) : lessons_(std::move(lessons)) {}

  void absorb(const PathLog& log) override {
    for (std::size_t i = 0; i < log.size(); ++i) lessons_.extract(log[i], samples_);
    if (samples_.size() >= lessons_.settings().batch_samples) learn();
  }

  Learned update(const TrainingStage&) override {
    learn();
    if (!cells_.know_something()) return {};
    Learned learned{lessons_.model(cells_), cells_.origins()};
    cells_.mark_origins();
    for (std::size_t i = 0; i < cells_.size(); ++i) cells_[i].forget(lessons_.settings().decay);
    return learned;
  }

  void end_learning() override { samples_ = {}; }

  void archive(Archive& archive) override {
    archive.heading(Lessons::kHeading, Lessons::kVersion);
    archive(lesson_, cells_, samples_);
  }

 private:
  using Sample = typename Lessons::Sample;
  using Cell = typename Lessons::Cell;

  /// Learns from the collected samples.
  void learn() {
    const auto& settings = lessons_.settings();
    const CellDivision division{.divides = settings.spatial == SpatialCells::kdtree,
                                .cell_samples = settings.cell_samples,
                                .max_depth = settings.max_depth,
                                .decay = settings.division_decay,
                                .splats = settings.splat,
                                .seed = hash_combine(lessons_.seed(), lesson_)};
    cells_.learn(samples_, division,
                 [&](Cell& cell, std::span<const Sample> samples, std::size_t number) {
                   lessons_.teach(cell, samples, lesson_, number);
                 });
    ++lesson_;
  }

  Lessons lessons_;
  KdTreeCells<Sample, Cell> cells_;
  std::uint64_t lesson_ = 0;     ///< number of calls of learn(); a key of random numbers
  std::vector<Sample> samples_;  ///< collected since the last call of learn()
};

}  // namespace pharos
