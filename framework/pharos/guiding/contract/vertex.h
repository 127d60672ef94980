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

/// Memory of one guide along one path. Whatever a guide leaves at a vertex is there at the next
/// vertex. If the path is copied, both copies continue with the same memory; so what is remembered
/// is constant, and a guide that has something new to remember makes a new object.
class PathMemory {
 public:
  PathMemory(const void*& slot, Arena& arena) : slot_(slot), arena_(arena) {}

  /// Returns what was left at the previous vertex; null: nothing.
  template <class T>
  const T* get() const {
    return static_cast<const T*>(slot_);
  }
  /// Makes an object that lives as long as the path and leaves it for the next vertex.
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
  Vec3 towards_previous;  ///< unit; on the lens its normal
  Transport transport = Transport::radiance;
  /// Number of the current vertex; the first vertex after the lens is 1. It is 0 if paths are made
  /// from both ends: the density of a step must not depend on the end that a path began at. The
  /// event at `previous` is then unknown for the same reason.
  std::uint16_t bounce = 1;
  const LocalScattering* scattering = nullptr;  ///< BSDF or phase function at the vertex
  const Medium* medium = nullptr;               ///< that the path came through; null: empty space
  std::uint32_t region = 0;           ///< that GuidingModel::place() returned for this vertex
  const PathMemory* memory = nullptr; /**< of this guide along this path; null if the density of a
                                           step is evaluated for a path made from the other end */
};

}  // namespace pharos
