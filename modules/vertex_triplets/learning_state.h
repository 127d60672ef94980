#pragma once

#include <span>
#include <vector>

#include <pharos/guiding/toolkit/pixel_estimates.h>

#include "cell_fit.h"
#include "learner.h"
#include "sample.h"

namespace pharos::vertex_triplets {

/// The state of learning during one render: samples in the cells of an octree that adapts to them.
/// Each update fits all mixtures from scratch. If VertexTripletsSettings::inherit is above 0, the
/// fits of cells made by division also use the mixtures that they inherited.
class VertexTripletsLearningState final : public LearningState {
 public:
  VertexTripletsLearningState(const VertexTripletsSettings& settings,
                              const LearningContext& context);

  void absorb(const PathLog& log) override;
  Learned update(const TrainingStage& stage) override;
  void archive(Archive& archive) override;

 private:
  /// The samples of a cell.
  struct Cell {
    Reservoir reservoir;
    double count = 0;  ///< number of samples since the last update
    /// Cell of the last model from which this cell comes; the first one if there are several.
    std::uint32_t origin = 0;
    /// The part of the parent's mixture that the cell got when its parent was divided. All fits use
    /// it as prior knowledge until the cell is divided or joined. It has little weight in cells
    /// with many samples. Empty if VertexTripletsSettings::inherit is 0.
    Inheritance inheritance = {};

    void archive(Archive& archive) { archive(reservoir, count, origin, inheritance); }
  };

  /// Inserts the waiting samples into the reservoirs of their cells.
  void insert();
  std::uint32_t jittered_cell(const Sample& sample, std::uint64_t number) const;
  /// Returns the number of each cell by which cells are compared: the number of its new samples, or
  /// the effective number of the samples that it keeps.
  std::vector<double> counts() const;
  void collapse(double threshold);
  /// Divides cells. `model` is the model of the cells before.
  void divide(double threshold, const VertexTripletsModel& model);
  /// Gives the eight parts of a cell of the model their inheritance.
  void inherit(std::span<Cell> parts, const VertexTripletsModel& model, std::uint32_t divided_cell,
               const Cube& divided) const;
  /// Adds a path to the estimates of pixels. Requires its radiance in `incident_`.
  void add_to_pixel(const PathView& path);
  Learned fit() const;
  std::uint64_t sample_bytes() const;

  VertexTripletsSettings settings_;
  FitRule rule_;
  std::uint64_t seed_;
  Octree tree_;
  std::vector<Cell> cells_;
  std::uint32_t camera_region_ = 0;  ///< region of the camera in the last model
  std::uint64_t lessons_ = 0;        ///< number of calls of insert()
  std::vector<Sample> samples_;      ///< samples that wait for insert()
  PixelEstimates pixels_;            ///< for SampleWeights::relative
  std::vector<Rgb> incident_;        ///< scratch
};

}  // namespace pharos::vertex_triplets
