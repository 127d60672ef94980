#pragma once

#include <cstdint>

#include <pharos/core/arena.h>
#include <pharos/guiding/contract/distribution.h>
#include <pharos/scene/local_scattering.h>

namespace pharos {

/// A path vertex as guides see it.
struct GuidingVertex {
  Point3 position;
  Vec3 normal;          ///< geometric, unit; zero in media
  Vec3 shading_normal;  ///< unit; zero in media
  VertexKind kind = VertexKind::surface;
  Event event = Event::none;  ///< event of the step from here; none at the current vertex
  float roughness = 1;
};

/// The memory of one guide along one path. An object that the guide leaves at a vertex is available
/// at the following vertices, until the guide leaves another object. If the path is copied, both
/// copies share the object. Objects are therefore constant, and a guide that needs to remember
/// something new makes a new object.
class PathMemory {
 public:
  PathMemory(const void*& slot, Arena& arena) : slot_(slot), arena_(arena) {}

  /// Returns the object that was left before, which must be of type `T`; null if there is none.
  template <class T>
  const T* get() const {
    return static_cast<const T*>(slot_);
  }
  /// Makes an object that lives as long as the path and leaves it for the next vertices.
  template <class T, class... Args>
  const T* leave(Args&&... args) const {
    const T* object = arena_.make<T>(std::forward<Args>(args)...);
    slot_ = object;
    return object;
  }

 private:
  const void*& slot_;
  Arena& arena_;
};

/// A request for a sampling distribution at a path vertex. Everything in it is a function of the
/// prefix of the path. At the first vertex, on the lens, `current.kind` is VertexKind::sensor,
/// and `previous` and `scattering` are null; only guiders that guide the camera are asked there.
struct GuidingQuery {
  const GuidingVertex* previous = nullptr;
  GuidingVertex current;
  Vec3 towards_previous;  ///< unit; on the lens the normal of the lens
  Transport transport = Transport::radiance;
  /// Number of the current vertex; the first vertex after the lens is 1. It is 0 if paths are made
  /// from both ends, because the density of a step must not depend on the end at which a path
  /// began. For the same reason the event at `previous` is then unknown.
  std::uint16_t bounce = 1;
  const LocalScattering* scattering = nullptr;  ///< BSDF or phase function; null on the lens
  const Medium* medium = nullptr;  ///< medium through which the path came; null: empty space
  std::uint32_t region = 0;        ///< region that GuidingModel::place() returned here
  /// The memory of this guide along this path. Null if paths are made from both ends, because the
  /// memory would depend on the end at which the path began.
  const PathMemory* memory = nullptr;
};

}  // namespace pharos
