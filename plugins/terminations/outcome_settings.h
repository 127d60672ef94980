#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <pharos/config/schema.h>
#include <pharos/guiding/contract/termination.h>
#include <pharos/guiding/toolkit/kd_tree.h>

#include "film_estimate.h"
#include "throughput.h"

namespace pharos {

/// Settings of terminations that learn what steps find. The defaults are those of the program that
/// its authors have published with EARS (Rath et al. 2022), unless a comment says otherwise.
struct OutcomeSettings {
  /// `first_vertex` is the default of `depth`.
  explicit OutcomeSettings(std::uint16_t first_vertex) : depth(first_vertex) {}

  float least = 0.05f, most = 20;
  std::uint16_t depth;
  std::uint32_t first_iterations = 3;
  /// EARS divides a cell of an octree by eight if one of its bins has 20,000 steps. Here cells are
  /// halved, so that they adapt to where paths go. Cells that are too small do no harm, because
  /// larger ones speak for them (`least_steps`).
  std::uint32_t cell_steps = 20'000;
  std::uint32_t cell_depth = 24;
  std::uint32_t direction_rows = 4;
  /// The cells of EARS take 24 MiB at most, and so do these with 16 bins each.
  std::uint32_t most_cells = 49'152;
  double least_steps = 40'000;
  double decay = 1;
  std::uint32_t outliers = 10;
  Denoising denoising;
  /// EARS adds 0.01, whatever the brightness of the image is. Relative to the mean, a render does
  /// not change with the unit of radiance. The test scenes of EARS have means of about one half.
  double pixel_offset = 0.02;
  std::uint32_t batch_steps = 1'000'000;
  ThroughputTermination::Settings first;

  /// Returns whether paths are left alone at a vertex.
  bool spares(const TerminationQuery& query) const {
    return query.discrete || query.bounce < depth;
  }
  /// Returns the factor within its bounds; the least one if it is undefined.
  float clamped(float factor) const { return factor > least ? std::min(factor, most) : least; }
  /// Returns the number of paths of a pass over an image of so many pixels, each of which has
  /// `outliers`. Small images have longer passes, which lose a hundredth of their paths.
  std::uint64_t pass(std::size_t pixels) const {
    return std::max<std::uint64_t>(pixels, std::uint64_t{100} * outliers);
  }
};

/// Declares the settings.
template <class Settings>
void describe_outcomes(Schema<Settings>& s) {
  s.field("least", &OutcomeSettings::least, "Least factor: the lowest probability of survival")
      .above(0)
      .at_most(1);
  s.field("most", &OutcomeSettings::most, "Largest factor: the highest mean number of branches")
      .at_least(1)
      .at_most(TerminationRule::kMostFactor);
  s.field("depth", &OutcomeSettings::depth,
          "Number of the first vertex at which paths may end or split; the first vertex after the "
          "lens is 1");
  s.field(
      "first_iterations", &OutcomeSettings::first_iterations,
      "Number of the first training iterations, which only learn and end paths as `first` says. "
      "The final image always uses what was learned");
  s.field("cell_steps", &OutcomeSettings::cell_steps,
          "A cell of space that has received more steps is divided")
      .at_least(16);
  s.field("cell_depth", &OutcomeSettings::cell_depth, "Largest number of planes above a cell")
      .at_most(KdTree::kMostLevels);
  s.field("most_cells", &OutcomeSettings::most_cells,
          "Number of cells from which on no cell is divided any more, which limits the memory")
      .at_least(1);
  s.field("direction_rows", &OutcomeSettings::direction_rows,
          "Rows of bins of directions in a cell; each row has as many bins as there are rows")
      .at_least(1)
      .at_most(16);
  s.field("least_steps", &OutcomeSettings::least_steps,
          "A bin with fewer steps is replaced by the same bin of the next larger cell")
      .at_least(0);
  s.field("decay", &OutcomeSettings::decay,
          "Factor by which an iteration weights what was found before, by other rules")
      .at_least(0)
      .at_most(1);
  s.field(
       "outliers", &OutcomeSettings::outliers,
       "Number of the largest squared errors that the error of the image omits, of as many paths "
       "as the image has pixels")
      .at_most(100'000);
  s.field("denoising", &OutcomeSettings::denoising, "How the radiance of pixels is denoised");
  s.field("pixel_offset", &OutcomeSettings::pixel_offset,
          "Errors and contributions are relative to the radiance of the pixel plus this many times "
          "the mean of the image")
      .above(0)
      .at_most(1);
  s.field("batch_steps", &OutcomeSettings::batch_steps,
          "Number of steps that are collected before the cells learn from them")
      .at_least(1);
  s.field("first", &OutcomeSettings::first,
          "Russian roulette with the throughput, until something is known");
}

}  // namespace pharos
