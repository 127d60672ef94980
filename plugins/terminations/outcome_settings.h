#pragma once

#include <algorithm>
#include <cmath>
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
  /// EARS has no such limit, but it learns in fifteen iterations of equal size. With a geometric
  /// schedule there may be four. Only the last one and the final image then use what was learned,
  /// and without a limit its factors have their final size at once.
  float growth = 2;
  std::uint16_t depth;
  std::uint32_t first_iterations = 3;
  /// Light samples count as well. EARS divides a cell of an octree by eight if one of its bins has
  /// 20,000 steps, and uses a bin with 40,000. Here cells are halved, so that they adapt to where
  /// paths go. Larger cells contribute to what small ones expect (`least_steps`), and rare large
  /// contributions are limited (`outliers`), so fewer steps suffice: in the classroom, 8000 and
  /// 2000 steps had about the same gain over path tracing (1.17 and 1.22).
  std::uint32_t cell_steps = 2000;
  std::uint32_t cell_depth = 24;
  std::uint32_t direction_rows = 4;
  /// The cells of EARS take 24 MiB at most, these 72 MiB with 16 bins each.
  std::uint32_t most_cells = 49'152;
  double least_steps = 2000;
  double decay = 1;
  /// EARS takes 10 for each image that is as large as the film, which is a fraction of 1e-5 of its
  /// paths, and for the error of the image alone. A short render has too few paths to learn from
  /// such rare ones: in the classroom, limits of 5, 15, 50 and 200 times the pixel have gains of
  /// 0.76, 1.03, 1.23 and 1.13 over path tracing, and this fraction has a limit of 40 to 80 times.
  double outliers = 0.0007;
  Denoising denoising;
  /// EARS adds 0.01, whatever the brightness of the image is. Relative to the mean, a render does
  /// not change with the unit of radiance. The test scenes of EARS have means of about one half.
  double pixel_offset = 0.02;
  std::uint32_t batch_steps = 200'000;
  ThroughputTermination::Settings first;

  /// Returns whether paths are left alone at a vertex.
  bool spares(const TerminationQuery& query) const {
    return query.discrete || query.bounce < depth;
  }
  /// Returns into how many branches a path may split in the `use`-th iteration that uses what was
  /// learned, from 1 on.
  float branches_in(std::uint32_t use) const {
    constexpr float kUnlimited = 1e6f;
    return std::min(std::pow(growth, static_cast<float>(use)), kUnlimited);
  }
  /// Returns the factor within its bounds, where a path may split into `branches` more; the least
  /// one if it is undefined.
  float clamped(float factor, float branches) const {
    return factor > least ? std::min({factor, most, std::max(branches, 1.0f)}) : least;
  }
  /// Returns how many outliers each pass() has.
  std::size_t outliers_of_pass() const { return outliers > 0 ? 10 : 0; }
  /// Returns the number of paths among which outliers are found.
  std::uint64_t pass() const {
    constexpr double kMost = 1e18;
    return outliers > 0 ? static_cast<std::uint64_t>(std::min(outliers_of_pass() / outliers, kMost))
                        : 1;
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
  s.field(
       "growth", &OutcomeSettings::growth,
       "In the first iteration that uses what was learned, a path splits into this number of "
       "branches at most, on average, and into as many times more in each later iteration. What "
       "steps find and cost depends on the factors at all later vertices, so factors must change "
       "slowly")
      .above(1);
  s.field("depth", &OutcomeSettings::depth,
          "Number of the first vertex at which paths may end or split; the first vertex after the "
          "lens is 1");
  s.field(
      "first_iterations", &OutcomeSettings::first_iterations,
      "Number of the first training iterations, which only learn and end paths as `first` says. "
      "The final image always uses what was learned");
  s.field("cell_steps", &OutcomeSettings::cell_steps,
          "A cell of space that has received more steps and light samples is divided")
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
  s.field(
       "least_steps", &OutcomeSettings::least_steps,
       "The same bin of the next larger cell counts as much as this number of steps; cells whose "
       "bins have fewer are not used")
      .at_least(0);
  s.field("decay", &OutcomeSettings::decay,
          "Factor by which an iteration weights what was found before, by other rules")
      .at_least(0)
      .at_most(1);
  s.field("outliers", &OutcomeSettings::outliers,
          "Fraction of the paths that are outliers. These paths have the largest errors, and each "
          "counts "
          "as if it had the smallest of them. The variance of steps is limited alike. 0: none")
      .at_least(0)
      .at_most(0.1);
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
