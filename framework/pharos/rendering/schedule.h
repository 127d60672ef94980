#pragma once

#include <cstdint>
#include <vector>

#include <pharos/guiding/pipeline/training_settings.h>
#include <pharos/rendering/budget.h>

namespace pharos {

/// One iteration of a render. It renders an image of its own, and the guides are frozen meanwhile.
struct Iteration {
  std::uint32_t samples = 0;  ///< samples per pixel; 0: limited by `seconds`
  double seconds = 0;         ///< 0: limited by `samples`
  bool training = false;      ///< paths are recorded and the models are updated afterward
  bool keeps_image = true;    ///< its image is part of the result
};

/// Divides a budget into training iterations and the final image, which comes last. A sample budget
/// is divided exactly: `uniform` gives all training iterations the same number of samples, and
/// `geometric` doubles the number from one iteration to the next. If the budget does not suffice,
/// there are fewer iterations. The samples that training leaves over go to the final image in whole
/// granules of `granule` samples (the preferred number of a sampler), and the rest go to the last
/// training iteration. Without training, the budget is one iteration.
std::vector<Iteration> divide(const Budget& budget, const TrainingSettings& training,
                              std::uint32_t granule);

}  // namespace pharos
