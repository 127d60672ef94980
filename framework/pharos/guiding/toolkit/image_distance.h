#pragma once

#include <vector>

#include <pharos/guiding/record/path_record.h>

namespace pharos {

/// For each vertex of a path the distance of the image that the step from it shows [scene units]:
/// it goes on past smooth surfaces, through lenses as far as thin ones would show (Ruppert et al.
/// 2020, section 5.1). Infinite for the environment; of the first step where the path branches; 0
/// where no step was taken. Surfaces show what is behind them when what the path did there was
/// discrete or their roughness is below `glossy`.
void image_distances(const PathView& path, float glossy, std::vector<float>& distances);

}  // namespace pharos
