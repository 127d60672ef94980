#pragma once

#include <cstdint>
#include <filesystem>

namespace pharos::testing {

/// Writes a binary PLY with `spheres` spheres at random positions in [-1,1]^3. Each sphere has
/// 4 * `rings` * (`rings` - 1) triangles. The same seed gives the same mesh. Returns the number of
/// triangles.
std::size_t write_sphere_field(const std::filesystem::path& path, int spheres, int rings,
                               std::uint64_t seed = 1);

}  // namespace pharos::testing
