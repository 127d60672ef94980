#pragma once

#include <cstdint>

#include <pharos/core/archive.h>
#include <pharos/rendering/film.h>
#include <pharos/rendering/pass_sizes.h>

namespace pharos {

/// The current iteration of a render between two work units.
struct IterationState {
  Film film;
  PassSizes sizes;
  double start = 0;          ///< on the budget's clock [s]
  std::uint32_t done = 0;    ///< samples per pixel of whole passes
  std::uint32_t pass = 0;    ///< samples per pixel of the pass in progress; 0: there is none
  std::uint64_t units = 0;   ///< work units of this pass that are merged
  double pixel_samples = 0;  ///< samples of these units, of all pixels together

  void archive(Archive& archive) { archive(film, sizes, done, pass, units, pixel_samples); }
};

}  // namespace pharos
