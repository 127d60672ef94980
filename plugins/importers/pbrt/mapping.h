#pragma once

#include <optional>

#include <pharos/config/node.h>

#include "scene.h"
#include "statements.h"

/// The mapping of pbrt's objects to plugins. All functions note what is approximated or left out,
/// and throw InputError, located in the scene, for types that pbrt does not have (with the nearest
/// one) and for parameters of the wrong kind.
namespace pharos::pbrt {

/// The directives before WorldBegin that describe the view.
struct View {
  std::optional<Statement> camera, film, filter, sampler, integrator;
  Transform camera_to_world;
  std::string camera_medium;
};

/// Sets the sensor, film, sampler, integrator and budget of the scene.
void map_view(Scene& scene, const View& view);

/// Defines the texture of a directive Texture.
void map_texture(Scene& scene, const Statement& texture);

/// Returns the material of a directive Material or MakeNamedMaterial.
ConfigNode map_material(Scene& scene, const Statement& material);

/// Defines the medium of a directive MakeNamedMedium.
void map_medium(Scene& scene, const Statement& medium);

/// Adds the light of a directive LightSource.
void map_light(Scene& scene, const Statement& light);
/// Returns the emitter of a shape by a directive AreaLightSource.
ConfigNode map_area_light(Scene& scene, const Statement& light);

/// Adds the shape of a directive Shape, with the material, light and media of the state.
void map_shape(Scene& scene, const Statement& shape);

}  // namespace pharos::pbrt
