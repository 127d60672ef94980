#pragma once

#include <array>
#include <cstdint>

#include <pharos/core/archive.h>
#include <pharos/core/vec.h>
#include <pharos/scene/events.h>

namespace pharos::vertex_triplets {

/// The light transport mode of a triplet (Schuessler et al. 2022, section 4.1): the kinds of the
/// vertices before and after, seen along a path from the sensor, and the event at the vertex
/// itself. VertexKind::light stands for any light that no step can hit. The events at the outer
/// vertices are not part of the mode, because they are not known when it is sampled.
struct Mode {
  VertexKind before = VertexKind::surface;
  Event event = Event::smooth_reflect;
  VertexKind after = VertexKind::surface;

  void archive(Archive& archive);
  friend bool operator==(const Mode&, const Mode&) = default;
  friend auto operator<=>(const Mode&, const Mode&) = default;
};

/// Three consecutive vertices of a path, in the order of a path from the sensor.
struct Triplet {
  std::array<Point3, 3> vertices;  ///< environment vertices are at EnvironmentShell::at()
  Mode mode;
  void archive(Archive& archive) { archive(vertices, mode); }
};

/// Places the environment at a finite distance: a direction becomes a point at distance `radius`
/// from the vertex from which it is seen.
struct EnvironmentShell {
  float radius = 1;  ///< [scene units]
  Point3 at(Point3 from, Vec3 direction) const { return from + radius * direction; }
};

/// The vertices of a path prefix that a model depends on.
enum class Prefix {
  pair,    ///< the current vertex alone: a mixture over (x_i, x_i+1), the method "pairs"
  triplet  ///< the previous one, too: a mixture over (x_i-1, x_i, x_i+1)
};
/// Returns the number of dimensions of a prefix.
constexpr int prefix_dimensions(Prefix prefix) {
  return prefix == Prefix::pair ? 3 : 6;
}

}  // namespace pharos::vertex_triplets
