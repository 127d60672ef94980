#pragma once

#include <array>
#include <cstdint>

#include <pharos/core/vec.h>
#include <pharos/scene/events.h>

namespace pharos::vertex_triplets {

/// The kind of light transport around a vertex (Schuessler et al. 2022, section 4.1): what the
/// vertices before and after it lie on (VertexKind::light: any light that no step can meet), seen
/// along a path from the sensor, and what happens at itself. What happens at the outer ones is not
/// known when it is sampled.
struct Mode {
  VertexKind before = VertexKind::surface;
  Event event = Event::smooth_reflect;
  VertexKind after = VertexKind::surface;

  friend bool operator==(const Mode&, const Mode&) = default;
  friend auto operator<=>(const Mode&, const Mode&) = default;
};

/// Three vertices of a path in a row, as seen along a path from the sensor.
struct Triplet {
  std::array<Point3, 3> vertices;  ///< that of an environment at EnvironmentShell::at()
  Mode mode;
};

/// Where the environment is taken to be: directions become points that far from the vertex which
/// they are seen from.
struct EnvironmentShell {
  float radius = 1;  ///< [scene units]
  Point3 at(Point3 from, Vec3 direction) const { return from + radius * direction; }
};

/// What a model knows of paths before the vertex where it is asked.
enum class Prefix {
  pair,    ///< that vertex: (x_i, x_i+1), the method "pairs"
  triplet  ///< the one before too: (x_i-1, x_i, x_i+1)
};
/// Dimensions of a prefix, and of it with the next vertex.
constexpr int prefix_dimensions(Prefix prefix) {
  return prefix == Prefix::pair ? 3 : 6;
}

}  // namespace pharos::vertex_triplets
