#pragma once

#include <cstdint>
#include <optional>

#include <pharos/core/bounds.h>
#include <pharos/core/vec.h>
#include <pharos/sampling/sampler.h>
#include <pharos/scene/events.h>

namespace pharos {

/// A set of kinds of path vertices.
enum class TargetMask : std::uint8_t { surface = 1, volume = 2, environment = 4, all = 7 };

constexpr TargetMask operator|(TargetMask a, TargetMask b) {
  return static_cast<TargetMask>(static_cast<std::uint8_t>(a) | static_cast<std::uint8_t>(b));
}
constexpr bool contains(TargetMask set, VertexKind kind) {
  const auto bits = static_cast<std::uint8_t>(set);
  switch (kind) {
    case VertexKind::volume:
      return (bits & 2) != 0;
    case VertexKind::environment:
      return (bits & 4) != 0;
    default:
      return (bits & 1) != 0;
  }
}

/// Returns whether a vertex of this kind is among `targets` and lies inside the box `within`. A
/// null box contains all points.
inline bool is_target(TargetMask targets, const Bounds3* within, VertexKind kind, Point3 position) {
  return contains(targets, kind) && (within == nullptr || within->contains(position));
}

/// A proposal for the next path vertex.
struct Proposal {
  /// The rule that decides how far the path goes along `direction`.
  enum class Reach : std::uint8_t {
    medium,   ///< the medium samples a distance, as in unguided paths
    surface,  ///< the path crosses the medium to the next surface or the environment
    distance  ///< the path ends in the medium at `distance`
  };

  Vec3 direction;  ///< unit, away from the current vertex
  /// The events that the step may have. If the set contains only discrete events, the step is the
  /// first discrete outcome of the BSDF with one of these events, and it takes the direction of
  /// this outcome. Otherwise the step goes along `direction`, and the sample has value zero if its
  /// event is not in the set.
  EventMask events = EventMask::smooth;
  Reach reach = Reach::medium;
  float distance = 0;                    ///< used with Reach::distance [scene units]
  TargetMask targets = TargetMask::all;  ///< a next vertex of another kind is a zero sample
  const Bounds3* within = nullptr; /**< a next vertex outside this box is a zero sample; the box
                                        lives as long as the guide; null: no limit */

  /// Returns whether a next vertex of this kind and position was proposed.
  bool accepts(VertexKind kind, Point3 position) const {
    return is_target(targets, within, kind, position);
  }
};

/// Returns a proposal of a direction alone. It is constructed in place, because a copy would read
/// at once what was written in parts, which stalls the walks.
inline std::optional<Proposal> propose_direction(Vec3 direction) {
  std::optional<Proposal> proposal(std::in_place);
  proposal->direction = direction;
  return proposal;
}

/// A next vertex as it was found: by tracing a proposal or an unguided sample, by next event
/// estimation, or by the other end of a bidirectional path.
struct ResolvedVertex {
  Vec3 direction;      ///< unit, from the current vertex
  float distance = 0;  ///< infinite for the environment [scene units]
  Point3 position;     ///< undefined for the environment
  VertexKind kind = VertexKind::surface;
  Event event = Event::none;  ///< event of the step at the current vertex
  /// The medium's factor in the density of the step: the density [1/m] of stopping at `distance`
  /// (volume) or the probability [1] of reaching the vertex (surface, environment). It is 1 in
  /// empty space.
  float medium_density = 1;
};

/// The sampling distribution of a guide at one path vertex. It proposes the next vertex and
/// evaluates the density of any next vertex. It lives in the arena of the query that made it and is
/// constant.
///
/// The density of the vertices that propose() can lead to integrates to at most one, over discrete
/// events, directions and distances together. The integral is below one if proposals can end as
/// zero samples.
class GuidingDistribution {
 public:
  /// Draws a proposal with the stream's guide_* dimensions. Returns an empty optional for a valid
  /// sample of value zero.
  virtual std::optional<Proposal> propose(const VertexStream& stream) const = 0;

  /// Returns the density with which propose() leads to `vertex`, summed over all ways to propose
  /// it, in the measure measure_of(vertex.event, vertex.kind). If the medium decides the distance
  /// of a proposal, the density contains the factor `vertex.medium_density`; this holds for
  /// discrete events too. Guides that never steer distances (GuiderTraits::steers_distance is
  /// false) leave this factor out and return [1/sr], or [1] for discrete events; the framework
  /// multiplies it in.
  virtual float density(const ResolvedVertex& vertex) const = 0;

 protected:
  ~GuidingDistribution() = default;  // arenas run no destructors
};

}  // namespace pharos
