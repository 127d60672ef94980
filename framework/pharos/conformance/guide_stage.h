#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pharos/conformance/check.h>
#include <pharos/conformance/subjects.h>
#include <pharos/guiding/pipeline/guiding_frame.h>
#include <pharos/rendering/render_job.h>

/// The stage for tests of guides: small rooms that a learner has seen.
namespace pharos::conformance {

/// The rooms. They contain the same objects and differ in what emits light.
enum class Room {
  lamp,    ///< one small lamp
  furnace  ///< every surface except the mirror emits light
};

/// Returns a room of matte walls with a ball and a half mirror, with or without fog.
SceneParts room_parts(Room room, bool foggy);

/// A pair of learner and guider that is tested.
struct GuidedPair {
  const Registry& registry;
  const Subject& guider;
  const Subject& learner;

  const Guider& the_guider() const { return static_cast<const Guider&>(*guider.component); }
  const Learner& the_learner() const { return static_cast<const Learner&>(*learner.component); }
};

/// Returns the integrators of the registry that can ask this pair, the default one first. If there
/// are none, the list is empty and `why_not` is set to the reason.
std::vector<Ref<Integrator>> integrators_for(const GuidedPair& pair, std::string& why_not);
/// Returns the same integrator without guiding.
Ref<Integrator> unguided(const GuidedPair& pair, const Integrator& guided);

/// Builds a plugin from its node.
template <class C>
Ref<C> build_plugin(const Registry& registry, const ConfigNode& node) {
  BuildContext context{registry};
  ConfigNode resolved;
  return registry.build<C>(node, context, resolved);
}

/// Returns the names of all integrators, the default one first.
std::vector<std::string> integrator_names(const Registry& registry);

/// Renders a small image of a room with the default filter and the default sampler.
RenderResult render_room(const Registry& registry, const Ref<Integrator>& integrator, Room room,
                         bool foggy, std::uint32_t samples, std::uint64_t seed);

/// An integrator, and what it is called in messages.
struct Rendering {
  const Ref<Integrator>& integrator;
  const char* name;
};
/// Tests that both integrators render the same mean in a furnace.
void compare_in_furnace(const Registry& registry, const Rendering& a, const Rendering& b,
                        bool foggy, std::uint64_t seed, Check& check);

/// A vertex of a path through a room, with the query that a guide gets there.
class StageVertex {
 public:
  StageVertex(const Scene& scene, const GuidingVertex& previous, const SurfacePoint& point,
              const Medium* medium, bool in_medium, Vec3 towards_previous, std::uint16_t bounce,
              Transport transport = Transport::radiance);
  StageVertex(const StageVertex&) = delete;
  StageVertex& operator=(const StageVertex&) = delete;

  const GuidingQuery& query() const { return query_; }
  const LocalScattering& scattering() const { return scattering_; }
  /// Returns the surface or environment that a ray along `direction` reaches if no medium stops it.
  ResolvedVertex surface_along(Vec3 direction, Event event) const;
  /// Returns the medium of a ray that leaves here; null: empty space.
  const Medium* medium() const { return medium_; }
  /// Returns a description such as "bounce 2 in fog at (x, y, z)".
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

/// Returns the first and second vertices of a few paths, some of them on the half mirror, and in
/// fog. Guides are asked there as they are for paths of this transport.
std::vector<std::unique_ptr<const StageVertex>> stage_vertices(
    const Scene& scene, std::uint64_t seed, Transport transport = Transport::radiance);

}  // namespace pharos::conformance
