#pragma once

#include <cstdint>
#include <filesystem>

namespace pharos::testing {

/// Writes a binary PLY of `spheres` spheres scattered in [-1,1]^3, each of 2 * `rings` * (`rings` -
/// 1) triangles or so, the same for the same seed. Returns the number of triangles.
std::size_t write_sphere_field(const std::filesystem::path& path, int spheres, int rings,
                               std::uint64_t seed = 1);

}  // namespace pharos::testing
