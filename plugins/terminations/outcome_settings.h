#pragma once

#include <algorithm>
#include <cstdint>

#include <pharos/config/schema.h>
#include <pharos/guiding/toolkit/kd_tree.h>

#include "throughput.h"

namespace pharos {

/// Settings of terminations that learn what steps find.
struct OutcomeSettings {
  float least = 0.05f, most = 20;
  std::uint32_t cell_steps = 4096;
  std::uint32_t cell_depth = 24;
  std::uint32_t direction_rows = 4;
  double prior = 16;
  double decay = 1;
  double outlier = 50;
  std::uint32_t pixel_radius = 2;
  double least_pixel = 0.05;
  std::uint32_t batch_steps = 1'000'000;
  ThroughputTermination::Settings first;

  float clamped(float factor) const { return std::clamp(factor, least, most); }
};

/// Declares the settings.
template <class Settings>
void describe_outcomes(Schema<Settings>& s) {
  s.field("least", &OutcomeSettings::least, "Least factor: the lowest probability of survival")
      .above(0)
      .at_most(1);
  s.field("most", &OutcomeSettings::most, "Largest factor: the highest mean number of branches")
      .at_least(1)
      .at_most(1000);
  s.field("cell_steps", &OutcomeSettings::cell_steps,
          "A cell of space that has received more steps is divided")
      .at_least(16);
  s.field("cell_depth", &OutcomeSettings::cell_depth, "Largest number of planes above a cell")
      .at_most(KdTree::kMostLevels);
  s.field("direction_rows", &OutcomeSettings::direction_rows,
          "Rows of bins of directions in a cell; each row has twice as many bins as there are rows")
      .at_least(1)
      .at_most(16);
  s.field("prior", &OutcomeSettings::prior,
          "Number of steps as which the mean of a cell counts in each of its bins, and the mean of "
          "the scene in each cell")
      .at_least(0);
  s.field("decay", &OutcomeSettings::decay,
          "Factor by which an iteration weights what was found before, by other rules")
      .at_least(0)
      .at_most(1);
  s.field(
       "outlier", &OutcomeSettings::outlier,
       "A step or path counts at most as if its contribution were this many times the radiance of "
       "its pixel")
      .above(0);
  s.field("pixel_radius", &OutcomeSettings::pixel_radius,
          "Radiance of pixels is averaged over the pixels up to this distance along both axes")
      .unit("pixels")
      .at_most(100);
  s.field("least_pixel", &OutcomeSettings::least_pixel,
          "Least radiance of a pixel, relative to the mean of the image")
      .above(0)
      .at_most(1);
  s.field("batch_steps", &OutcomeSettings::batch_steps,
          "Number of steps that are collected before the cells learn from them")
      .at_least(1);
  s.field("first", &OutcomeSettings::first,
          "Russian roulette with the throughput, until something is known");
}

}  // namespace pharos
