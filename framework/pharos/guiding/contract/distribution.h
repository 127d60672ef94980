#pragma once

#include <cstdint>
#include <optional>

#include <pharos/core/bounds.h>
#include <pharos/core/vec.h>
#include <pharos/sampling/sampler.h>
#include <pharos/scene/events.h>

namespace pharos {

/// A density with the measure it refers to.
struct Density {
  float value = 0;
  Measure measure = Measure::solid_angle;
};

/// Kinds of next vertex, as a set.
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

/// Whether a vertex of this kind is among `targets`, and in the box, if there is one.
inline bool is_target(TargetMask targets, const Bounds3* within, VertexKind kind, Point3 position) {
  return contains(targets, kind) && (within == nullptr || within->contains(position));
}

/// What a guide proposes for the next vertex.
struct Proposal {
  /// Who decides how far the path goes along `direction`.
  enum class Reach : std::uint8_t {
    medium,   ///< the medium samples a distance, as unguided paths do
    surface,  ///< through the medium to the next surface or the environment
    distance  ///< to a volume vertex at `distance`
  };

  Vec3 direction;  ///< unit, away from the current vertex
  /// Events that the step may be. A discrete event here means: take that discrete outcome, along
  /// its own direction. A smooth direction that turns out to be another event is a zero sample.
  EventMask events = EventMask::smooth;
  Reach reach = Reach::medium;
  float distance = 0;                    ///< for Reach::distance [scene units]
  TargetMask targets = TargetMask::all;  ///< another kind of next vertex is a zero sample
  const Bounds3* within = nullptr; /**< so is a next vertex outside this box, which lives as long as
                                        the guide; null: anywhere */

  /// Whether a next vertex like this is one that was proposed.
  bool accepts(VertexKind kind, Point3 position) const {
    return is_target(targets, within, kind, position);
  }
};

/// A next vertex as it was found: by tracing a proposal or an unguided sample, by next event
/// estimation, or by the other end of a bidirectional path.
struct ResolvedVertex {
  Vec3 direction;      ///< unit, from the current vertex
  float distance = 0;  ///< infinite for the environment [scene units]
  Point3 position;     ///< meaningless for the environment
  VertexKind kind = VertexKind::surface;
  Event event = Event::none;  ///< what the step is at the current vertex
  /// What the medium's own sampling contributes: the density [1/m] of stopping at `distance`
  /// (volume) or the probability [1] of getting there (surface, environment); 1 in empty space.
  float medium_density = 1;
};

/// How a model is sampled at one vertex: proposes the next vertex and knows its density. Lives in
/// the arena of the query that made it; constant.
///
/// The densities of all vertices that propose() can lead to integrate to at most one (less where
/// proposals end as zero samples), per discrete event and over direction and distance together.
class GuidingDistribution {
 public:
  /// Draws from the stream's guide_* dimensions. Empty for a valid sample of value zero.
  virtual std::optional<Proposal> propose(const VertexStream& stream) const = 0;

  /// The density of proposing `vertex`, summed over every branch that could have made it, in the
  /// measure measure_of(vertex.event, vertex.kind). Branches whose distance the medium decides
  /// contain the factor `vertex.medium_density`, after discrete events too. Guides that never steer
  /// distances (GuiderTraits::steers_distance false) leave the factor out and return [1/sr] or, for
  /// discrete events, [1]; the caller multiplies it in.
  virtual Density density(const ResolvedVertex& vertex) const = 0;

  /// The part of the model that this comes from; learned mixing is keyed by it. Below
  /// GuidingModel::region_count().
  virtual std::uint32_t region() const { return 0; }

 protected:
  ~GuidingDistribution() = default;  // arenas run no destructors
};

}  // namespace pharos
