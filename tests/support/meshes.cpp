#include "meshes.h"

#include <array>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include <pharos/core/random.h>
#include <pharos/core/vec.h>

namespace pharos::testing {
namespace {

struct Soup {
  std::vector<Vec3> positions;
  std::vector<std::array<std::int32_t, 3>> triangles;

  void add_sphere(Vec3 center, float radius, int rings) {
    const int segments = 2 * rings;
    const auto base = static_cast<std::int32_t>(positions.size());
    for (int i = 0; i <= rings; ++i) {
      const float theta = kPi * static_cast<float>(i) / static_cast<float>(rings);
      for (int j = 0; j < segments; ++j) {
        const float phi = 2 * kPi * static_cast<float>(j) / static_cast<float>(segments);
        positions.push_back(center + radius * Vec3{std::sin(theta) * std::cos(phi),
                                                   std::sin(theta) * std::sin(phi),
                                                   std::cos(theta)});
      }
    }
    for (int i = 0; i < rings; ++i) {
      for (int j = 0; j < segments; ++j) {
        const int a = base + i * segments + j, b = base + i * segments + (j + 1) % segments;
        const int c = a + segments, d = b + segments;
        if (i > 0) triangles.push_back({a, c, b});
        if (i + 1 < rings) triangles.push_back({b, c, d});
      }
    }
  }
};

template <class T>
void put(std::ostream& out, const T& value) {
  out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

std::size_t write_sphere_field(const std::filesystem::path& path, int spheres, int rings,
                               std::uint64_t seed) {
  Soup soup;
  RandomStream random(seed);
  for (int s = 0; s < spheres; ++s) {
    const Vec2 xy = random.next_2d();
    const Vec2 zr = random.next_2d();
    const Vec3 center = 2 * Vec3{xy.x, xy.y, zr.x} - Vec3{1, 1, 1};
    soup.add_sphere(center, 0.03f + 0.1f * zr.y, rings);
  }
  std::ofstream out(path, std::ios::binary);
  out << "ply\nformat binary_little_endian 1.0\nelement vertex " << soup.positions.size()
      << "\nproperty float x\nproperty float y\nproperty float z\nelement face "
      << soup.triangles.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3& p : soup.positions) put(out, p);
  for (const auto& t : soup.triangles) {
    put(out, std::uint8_t{3});
    put(out, t);
  }
  return soup.triangles.size();
}

}  // namespace pharos::testing
