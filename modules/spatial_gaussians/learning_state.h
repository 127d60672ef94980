#pragma once

#include <cstdint>
#include <vector>

#include <pharos/guiding/learner.h>

#include "cell_mixture.h"
#include "gaussian_model.h"

namespace pharos::gaussians {

/// What is learned during one render: a tree whose cells are divided where many samples come, and a
/// mixture in each.
class GaussianState final : public LearningState {
 public:
  GaussianState(const GaussianSettings& settings, const LearningContext& context);

  void absorb(const PathLog& log) override;
  std::shared_ptr<const GuidingModel> update(std::uint32_t iteration, bool last) override;
  void save(std::ostream& out) const override;
  void load(std::istream& in) override;
  void merge(const LearningState& other) override;

 private:
  /// What is known of the positions at which a cell's samples began.
  struct Positions {
    double count = 0, sums[3] = {}, squares[3] = {};

    void add(Point3 p);
    int widest_axis() const;
  };
  struct Cell {
    CellMixture mixture;
    Positions positions;   ///< since the cell was last divided
    bool is_done = false;  ///< with the samples that wait
  };
  /// A cell that may have to be divided.
  struct Place {
    std::uint32_t leaf, cell;
    int level;
  };

  /// Learns from the samples that wait: at the end of an iteration, or when they are many.
  void learn();
  /// Puts the samples that wait into the order of their cells; returns where each cell's begin.
  std::vector<std::size_t> sort_by_cell();
  /// Lets cells learn from their samples, which begin at `first`, that are not done; only those
  /// that know nothing, if `unknowing`.
  void update_cells(const std::vector<std::size_t>& first, bool unknowing);
  /// Divides cells with too many samples, but for those that know nothing: their halves would know
  /// even less.
  void divide_cells(const std::vector<std::size_t>& first);
  void divide(Place place, std::span<Sample> samples);
  std::shared_ptr<const GuidingModel> model() const;
  void read(std::istream& in);

  GaussianSettings settings_;
  SampleRule rule_;
  double scene_size_;  ///< diagonal [scene units]
  std::uint64_t seed_;
  KdTree tree_;
  std::vector<Cell> cells_{1};
  std::vector<std::uint32_t> origins_{0};  ///< of each cell, among those of the last model
  std::uint64_t lessons_ = 0;              ///< calls of learn()
  std::vector<Sample> samples_;            ///< that wait
  std::vector<Rgb> incident_;              ///< scratch
};

}  // namespace pharos::gaussians
