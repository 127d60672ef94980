// Mitsuba and Pharos share these conventions: right-handed coordinates, cameras that look along
// local +z and have +x on the left of the image, lights that emit from the side of the normal,
// reflecting materials that are black on the back, depth that counts segments, and the same units.
#include "mapping.h"

#include "emitters.h"
#include "integrators.h"
#include "sensors.h"
#include "shapes.h"

namespace pharos::mitsuba {
namespace {

/// Maps the scene's objects of a tag by `map(scene_map, object, list)`.
template <class Map>
ConfigNode list_of(const char* tag, Part& part, const Map& map, InputErrorList& errors) {
  ConfigNode list = ConfigNode::sequence(part.where());
  for (const Object* object : part.children(tag)) {
    errors.attempt([&] { map(part.map(), *object, list.items()); });
  }
  return list;
}

/// Marks the scene's definitions as read. Those that no shape refers to make no difference.
void skip_definitions(Part& part) {
  for (const char* tag : {"bsdf", "texture", "medium", "phase", "rfilter", "film", "sampler"}) {
    part.children(tag);
  }
}

void set_if_any(ConfigNode& scene, const char* key, ConfigNode part) {
  if (part.items().empty() && part.entries().empty()) return;
  scene.set(key, std::move(part), scene.where());
}

ConfigNode assembled(SceneMap& map, ConfigNode shapes, ConfigNode emitters, Camera& camera,
                     const Location& where) {
  ConfigNode scene = ConfigNode::mapping(where);
  set_if_any(scene, "textures", std::move(map.textures().entries));
  set_if_any(scene, "materials", std::move(map.materials().entries));
  set_if_any(scene, "media", std::move(map.media().entries));
  set_if_any(scene, "groups", std::move(map.groups().entries));
  set_if_any(scene, "shapes", std::move(shapes));
  set_if_any(scene, "emitters", std::move(emitters));
  set_if_any(scene, "sensor", std::move(camera.sensor));
  if (!camera.medium.is_null()) scene.set("medium", std::move(camera.medium), where);
  return scene;
}

/// Returns the parts of the config that come from the camera.
Camera read_camera(Part& part) {
  const Object* sensor = part.child("sensor");
  if (sensor != nullptr) return map_sensor(part.map(), *sensor);
  part.note("the scene has no sensor");
  Camera camera;
  camera.sensor = ConfigNode::mapping();
  return camera;
}

}  // namespace

Import map_document(const Document& document) {
  SceneMap map(document);
  const Object& root = *document.scene;
  Part part(map, root);
  InputErrorList errors;
  ConfigNode method;
  errors.attempt([&] {
    const Object* integrator = part.child("integrator");
    method = integrator != nullptr ? map_integrator(map, *integrator)
                                   : default_integrator(map, root.where);
  });
  Camera camera;
  errors.attempt([&] { camera = read_camera(part); });
  ConfigNode shapes = list_of("shape", part, map_shape, errors);
  ConfigNode emitters = list_of("emitter", part, map_emitter, errors);
  errors.raise();
  skip_definitions(part);
  part.finish();

  ConfigNode config = ConfigNode::mapping(root.where);
  config.set("scene", assembled(map, std::move(shapes), std::move(emitters), camera, root.where),
             root.where);
  if (!camera.film.film.is_null()) config.set("film", std::move(camera.film.film), root.where);
  if (!camera.sampler.is_null()) config.set("sampler", std::move(camera.sampler), root.where);
  config.set("integrator", std::move(method), root.where);
  if (!camera.budget.is_null()) config.set("budget", std::move(camera.budget), root.where);
  if (!camera.film.output.is_null())
    config.set("output", std::move(camera.film.output), root.where);
  map.result().config = std::move(config);
  return std::move(map.result());
}

}  // namespace pharos::mitsuba
