#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include <pharos/guiding/contract/model.h>

/// grid_guide: a small guiding method with spatial cells, to be copied. A grid divides the scene.
/// Each cell has a histogram of the directions from which light came in the last iteration.
namespace grid_guide {

/// The cells of a grid over a box.
struct Grid {
  pharos::Bounds3 box;      ///< empty: there are no cells [scene units]
  std::uint32_t cells = 0;  ///< along each axis

  std::uint32_t cell_count() const { return box.empty() ? 0 : cells * cells * cells; }
  /// Returns the cell of a point. Points outside of the box belong to the nearest cell.
  std::uint32_t cell_of(pharos::Point3 p) const;
};

/// A histogram over the sphere has bins of equal solid angle: rows of equal height in y, and
/// columns of equal angle about y.
inline constexpr std::uint32_t kRows = 8, kColumns = 16, kBins = kRows * kColumns;
std::uint32_t bin_of(pharos::Vec3 direction);

/// What one iteration has summed in one cell.
struct CellSums {
  std::vector<double> radiance = std::vector<double>(kBins);  ///< over density, by bin
  double steps = 0;  ///< number of steps that left the cell, with and without light
};

/// The learned histograms. Region i of the model is cell i.
class GridModel final : public pharos::GuidingModel {
 public:
  static constexpr std::string_view kName = "grid";

  GridModel() = default;  ///< knows nothing
  GridModel(Grid grid, const std::vector<CellSums>& sums);

  pharos::ModelInfo info() const override;
  void archive(pharos::Archive& archive) override;
  pharos::Place place(const pharos::GuidingVertex& vertex) const override;
  double density(pharos::Point3 point, const pharos::Vec3* direction) const override;

  /// Draws a direction in a cell that has evidence. The density is pdf().
  pharos::Vec3 sample(std::uint32_t cell, pharos::Vec2 u) const;
  /// Returns the density of sample() over solid angle [1/sr].
  float pdf(std::uint32_t cell, pharos::Vec3 direction) const;

 private:
  /// Returns the share of the directions in the bins up to and including `bin` of a cell.
  float share_up_to(std::uint32_t cell, std::uint32_t bin) const {
    return cumulative_[std::size_t{cell} * kBins + bin];
  }
  float share_of(std::uint32_t cell, std::uint32_t bin) const {
    return share_up_to(cell, bin) - (bin == 0 ? 0 : share_up_to(cell, bin - 1));
  }

  Grid grid_;
  std::vector<float> cumulative_;  ///< by cell, then by bin; the last bin of a cell has 1
  std::vector<float> evidence_;    ///< by cell: steps behind the histogram; 0: no light was found
  std::vector<float> radiance_;    ///< by cell: mean radiance, for pictures
};

}  // namespace grid_guide
