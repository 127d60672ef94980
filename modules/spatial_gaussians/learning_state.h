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
    Positions positions;  ///< since the cell was last divided
  };
  /// A cell that may have to be divided.
  struct Place {
    std::uint32_t leaf, cell;
    int level;
  };

  /// Puts the new samples into the order of their cells; returns where each cell's begin.
  std::vector<std::size_t> sort_by_cell();
  /// Divides cells with too many samples; returns the old cell of each.
  std::vector<std::uint32_t> divide_cells();
  void divide(Place place, std::span<Sample> samples, std::vector<std::uint32_t>& origins);
  std::shared_ptr<const GuidingModel> model(std::vector<std::uint32_t> origins) const;
  void read(std::istream& in);

  GaussianSettings settings_;
  SampleRule rule_;
  double scene_size_;  ///< diagonal [scene units]
  std::uint64_t seed_;
  KdTree tree_;
  std::vector<Cell> cells_{1};
  std::vector<Sample> samples_;  ///< of this iteration
  std::vector<Rgb> incident_;    ///< scratch
};

}  // namespace pharos::gaussians
