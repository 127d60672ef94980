#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pharos/conformance/subjects.h>
#include <pharos/guiding/pipeline/guiding_frame.h>
#include <pharos/rendering/render_job.h>

/// Where guides are tested: small rooms that a learner has seen.
namespace pharos::conformance {

/// The rooms: what they hold is the same, what shines differs.
enum class Room {
  lamp,    ///< one small lamp
  furnace  ///< every surface that is not a mirror shines
};

/// A room of matt walls with a ball and a half mirror, with or without fog.
SceneParts room_parts(Room room, bool foggy);

/// How a pair of learner and guider is rendered.
struct GuidedPair {
  const Registry& registry;
  const Subject& guider;
  const Subject& learner;

  const Guider& the_guider() const { return static_cast<const Guider&>(*guider.component); }
  const Learner& the_learner() const { return static_cast<const Learner&>(*learner.component); }
};

/// The integrators of the registry that ask this pair, the default one first; none, with the reason
/// in `why_not`, when there is none.
std::vector<Ref<Integrator>> integrators_for(const GuidedPair& pair, std::string& why_not);
/// The same integrator without guiding.
Ref<Integrator> unguided(const GuidedPair& pair, const Integrator& guided);

/// A small render of a room.
RenderResult render_room(const GuidedPair& pair, const Ref<Integrator>& integrator, Room room,
                         bool foggy, std::uint32_t samples, std::uint64_t seed);

/// A vertex of a path through a room, with what a guide is asked there.
class StageVertex {
 public:
  StageVertex(const Scene& scene, const GuidingVertex& previous, const SurfacePoint& point,
              const Medium* medium, bool in_medium, Vec3 towards_previous, std::uint16_t bounce,
              Transport transport = Transport::radiance);
  StageVertex(const StageVertex&) = delete;
  StageVertex& operator=(const StageVertex&) = delete;

  const GuidingQuery& query() const { return query_; }
  const LocalScattering& scattering() const { return scattering_; }
  /// What is met along `direction` when nothing stops the ray on the way: a surface.
  ResolvedVertex surface_along(Vec3 direction, Event event) const;
  /// The medium that a ray leaving here is in; null: empty space.
  const Medium* medium() const { return medium_; }
  /// "bounce 2 in fog at (x, y, z)".
  std::string text() const;

 private:
  Ray ray_towards(Vec3 direction) const;

  const Scene& scene_;
  GuidingVertex previous_;
  SurfacePoint point_;
  const Medium* medium_;
  LocalScattering scattering_;
  GuidingQuery query_;
};

/// The first and second vertices of a few paths, some of them on the half mirror, and in fog.
/// Guides are asked there as they are for paths of this transport.
std::vector<std::unique_ptr<const StageVertex>> stage_vertices(
    const Scene& scene, std::uint64_t seed, Transport transport = Transport::radiance);

}  // namespace pharos::conformance
