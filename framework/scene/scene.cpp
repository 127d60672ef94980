#include <utility>

#include <pharos/scene/accelerator.h>
#include <pharos/scene/scene.h>

namespace pharos {
namespace {

Bounds3 geometry_bounds(const SceneParts& parts) {
  Bounds3 box;
  for (const SceneObject& object : parts.objects) box.add(object.shape->bounds());
  return box;
}

Bounds3 all_bounds(const SceneParts& parts) {
  Bounds3 box = geometry_bounds(parts);
  if (parts.sensor != nullptr) box.add(parts.sensor->position());
  return box;
}

bool any_media(const SceneParts& parts) {
  bool found = parts.medium != nullptr;
  for (const SceneObject& o : parts.objects) {
    found = found || o.interior != nullptr || o.exterior != nullptr;
  }
  return found;
}

/// Where environments stand: around the geometry, or around nothing in particular.
EmitterSite site_around(const Bounds3& geometry) {
  const float radius = geometry.diagonal() / 2;
  if (!(radius > 0)) return {};
  return {.scene_center = geometry.center(), .scene_radius = radius};
}

}  // namespace

Scene::Scene(SceneParts parts)
    : parts_(std::move(parts)),
      bounds_(all_bounds(parts_)),
      accelerator_(std::make_unique<const Accelerator>(parts_.objects)),
      has_media_(any_media(parts_)) {
  place_lights();
}

Scene::~Scene() = default;

void Scene::place_lights() {
  EmitterSite site = site_around(geometry_bounds(parts_));
  object_lights_.assign(parts_.objects.size(), nullptr);
  object_light_index_.assign(parts_.objects.size(), -1);
  for (const SceneObject& object : parts_.objects) {
    if (object.emitter != nullptr) {
      site.shape = object.shape.get();
      lights_.push_back(object.emitter->place(site));
      object_lights_[site.object] = lights_.back().get();
      object_light_index_[site.object] = static_cast<int>(lights_.size()) - 1;
    }
    ++site.object;
  }
  site.shape = nullptr;
  site.object = 0;
  for (const Ref<Emitter>& emitter : parts_.emitters) {
    lights_.push_back(emitter->place(site));
    if (lights_.back()->is_environment()) {
      environment_lights_.push_back(static_cast<int>(lights_.size()) - 1);
    }
  }
}

std::size_t Scene::primitive_count() const {
  std::size_t count = 0;
  for (const SceneObject& object : parts_.objects) {
    const TriangleMesh* mesh = object.shape->mesh();
    count += mesh != nullptr ? mesh->triangles.size() : object.shape->primitive_count();
  }
  return count;
}

}  // namespace pharos
