#pragma once

#include <iosfwd>

#include "octree.h"

namespace pharos::focal {

/// Writes an octree for load_octree().
void save_octree(const Octree& octree, std::ostream& out);
/// What save_octree() wrote. Throws InputError when it is cut off or no octree.
Octree load_octree(std::istream& in);

}  // namespace pharos::focal
