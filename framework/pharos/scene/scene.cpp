#include <algorithm>
#include <cmath>
#include <utility>

#include <pharos/core/error.h>
#include <pharos/scene/accelerator.h>
#include <pharos/scene/scene.h>

namespace pharos {
namespace {

Bounds3 bounds_of(const std::vector<SceneObject>& objects) {
  Bounds3 box;
  for (const SceneObject& object : objects) box.add(object.shape->bounds());
  return box;
}

Bounds3 geometry_bounds(const SceneParts& parts) {
  Bounds3 box = bounds_of(parts.objects);
  std::vector<Bounds3> groups;
  for (const SceneGroup& group : parts.groups) groups.push_back(bounds_of(group.objects));
  for (const SceneInstance& i : parts.instances)
    box.add(placed_bounds(groups[i.group], i.to_world));
  return box;
}

Bounds3 with_sensor(Bounds3 box, const Sensor* sensor) {
  if (sensor != nullptr) box.add(sensor->position());
  return box;
}

/// Returns the objects in the order of Scene::objects().
std::vector<SceneObject> all_objects(const SceneParts& parts) {
  std::vector<SceneObject> all = parts.objects;
  for (const SceneGroup& group : parts.groups) {
    all.insert(all.end(), group.objects.begin(), group.objects.end());
  }
  return all;
}

bool bounds_media(const SceneObject& o) {
  return o.interior != nullptr || o.exterior != nullptr;
}

/// Whether light passes through an object's surfaces as if they were not there.
bool only_bounds_media(const SceneObject& o) {
  return o.emitter == nullptr && o.bsdf->events() == mask_of(Event::pass_through);
}

/// Returns a site with the bounding sphere of the geometry; the default site if there is none.
EmitterSite site_around(const Bounds3& geometry) {
  const float radius = geometry.diagonal() / 2;
  if (!(radius > 0)) return {};
  return {.scene_center = geometry.center(), .scene_radius = radius};
}

}  // namespace

Scene::Scene(SceneParts parts)
    : objects_(all_objects(parts)),
      emitters_(std::move(parts.emitters)),
      sensor_(std::move(parts.sensor)),
      medium_(std::move(parts.medium)),
      geometry_bounds_(geometry_bounds(parts)),
      bounds_(with_sensor(geometry_bounds_, sensor_.get())),
      accelerator_(std::make_unique<const Accelerator>(parts)),
      has_media_(medium_ != nullptr ||
                 std::any_of(objects_.begin(), objects_.end(), bounds_media)) {
  for (const SceneObject& o : objects_) facts_.push_back(facts_of(o));
  has_boundaries_ = std::any_of(facts_.begin(), facts_.end(),
                                [](const ObjectFacts& facts) { return facts.is_boundary; });
  place_lights();
}

Scene::~Scene() = default;

Scene::ObjectFacts Scene::facts_of(const SceneObject& object) {
  return {.bsdf = object.bsdf.get(),
          .events = object.bsdf->events(),
          .is_boundary = only_bounds_media(object)};
}

void Scene::place_lights() {
  EmitterSite site = site_around(geometry_bounds_);
  for (const SceneObject& object : objects_) {
    if (object.emitter != nullptr) {
      site.shape = object.shape.get();
      lights_.push_back(object.emitter->place(site));
      facts_[site.object].light = lights_.back().get();
      facts_[site.object].light_index = static_cast<int>(lights_.size()) - 1;
    }
    ++site.object;
  }
  site.shape = nullptr;
  site.object = 0;
  for (const Ref<Emitter>& emitter : emitters_) {
    lights_.push_back(emitter->place(site));
    if (lights_.back()->is_environment()) {
      environment_lights_.push_back(static_cast<int>(lights_.size()) - 1);
    }
  }
}

const Medium* Scene::medium_at(Point3 point) const {
  const Medium* medium = medium_.get();
  if (!has_media_ || sensor_ == nullptr) return medium;
  const Vec3 way = point - sensor_->position();
  Ray ray{sensor_->position(), normalize(way), length(way)};
  while (ray.t_max > 0) {
    SurfacePoint at;
    if (std::isinf(intersect(ray, at))) break;
    medium = medium_after(at, ray.direction, medium);
    // Aims at the point again, because the remaining distance may be less than a surface's error.
    ray.origin = at.origin_towards(ray.direction);
    const Vec3 rest = point - ray.origin;
    if (!(dot(rest, ray.direction) > 0)) break;
    ray.t_max = length(rest);
    ray.direction = rest / ray.t_max;
  }
  return medium;
}

std::size_t Scene::primitive_count() const {
  std::size_t count = 0;
  for (const SceneObject& object : objects_) {
    const TriangleMesh* mesh = object.shape->mesh();
    count += mesh != nullptr ? mesh->triangles.size() : object.shape->primitive_count();
  }
  return count;
}

}  // namespace pharos
