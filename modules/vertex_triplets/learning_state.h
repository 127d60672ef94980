#pragma once

#include <vector>

#include "cell_fit.h"
#include "learner.h"
#include "sample.h"

namespace pharos::vertex_triplets {

/// Samples in the cells of an octree that follows them; fits begin anew with each update.
class VertexTripletsLearningState final : public LearningState {
 public:
  VertexTripletsLearningState(const VertexTripletsSettings& settings,
                              const LearningContext& context);

  void absorb(const PathLog& log) override;
  Learned update(std::uint32_t iteration, bool last) override;
  void archive(Archive& archive) override;

 private:
  /// What is kept in a cell.
  struct Cell {
    Reservoir reservoir;
    double count = 0;          ///< of samples since the last update
    std::uint32_t origin = 0;  ///< cell of the last model that it was, or the first of several

    void archive(Archive& archive) { archive(reservoir, count, origin); }
  };

  /// Puts the samples that wait into their cells' reservoirs.
  void insert();
  std::uint32_t jittered_cell(const Sample& sample, std::uint64_t number) const;
  std::vector<double> counts() const;
  void collapse(double threshold);
  void divide(double threshold);
  Learned fit() const;
  std::uint64_t sample_bytes() const;

  VertexTripletsSettings settings_;
  FitRule rule_;
  std::uint64_t seed_;
  Octree tree_;
  std::vector<Cell> cells_;
  std::uint64_t lessons_ = 0;    ///< calls of insert()
  std::vector<Sample> samples_;  ///< that wait
  std::vector<Rgb> incident_;    ///< scratch
};

}  // namespace pharos::vertex_triplets
