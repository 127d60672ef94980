#pragma once

#include <vector>

#include <pharos/guiding/record/path_record.h>

namespace pharos {

/// Computes, for each vertex of a path, the distance of the image that is visible along the step
/// from this vertex [scene units] (Ruppert et al. 2020, section 5.1). The distance continues past
/// smooth surfaces. Refracting surfaces shift the image as thin lenses would. The distance is
/// infinite for the environment and 0 if no step was taken. If the path branches, it is the
/// distance for the first step. A surface counts as smooth if the path's event there was discrete
/// or if its roughness is below `glossy`.
void image_distances(const PathView& path, float glossy, std::vector<float>& distances);

}  // namespace pharos
