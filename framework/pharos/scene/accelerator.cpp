#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>
#include <string>

#if PHAROS_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
#include <tbb/task_arena.h>

#include <pharos/core/error.h>
#include <pharos/scene/accelerator.h>

namespace pharos {
namespace {

#if PHAROS_EMBREE_MAJOR >= 4

using QueryContext = RTCRayQueryContext;

void find_nearest(RTCScene scene, RTCRayHit& query) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  rtcIntersect1(scene, &query, &arguments);
}

void find_any(RTCScene scene, RTCRay& query) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  rtcOccluded1(scene, &query, &arguments);
}

#else

using QueryContext = RTCIntersectContext;

void find_nearest(RTCScene scene, RTCRayHit& query) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &query);
}

void find_any(RTCScene scene, RTCRay& query) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &query);
}

#endif

/// Rays begin at distance 0, because their origins already lie off the surface
/// (SurfacePoint::origin_towards).
RTCRay to_embree(const Ray& ray) {
  RTCRay r;
  r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
  r.tnear = 0;
  r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
  r.time = 0;
  r.tfar = ray.t_max;
  r.mask = ~0u;
  r.id = 0;
  r.flags = 0;
  return r;
}

Ray from_embree(const RTCRay& r) {
  return {{r.org_x, r.org_y, r.org_z}, {r.dir_x, r.dir_y, r.dir_z}, r.tfar};
}

/// A ray with a direction of unit length, as shapes require. Embree's directions within an instance
/// are not of unit length; distances along `ray` are `scale` times Embree's.
struct ShapeRay {
  Ray ray;
  float scale;
};

ShapeRay shape_ray(const RTCRay& query, const QueryContext& context) {
  Ray ray = from_embree(query);
  if (context.instID[0] == RTC_INVALID_GEOMETRY_ID) return {ray, 1};
  const double size = precise_length(ray.direction);
  const auto scaled = [&](float v) { return static_cast<float>(v / size); };
  ray.direction = {scaled(query.dir_x), scaled(query.dir_y), scaled(query.dir_z)};
  const float scale = static_cast<float>(size);
  ray.t_max *= scale;
  return {ray, scale};
}

void analytic_bounds(const RTCBoundsFunctionArguments* args) {
  const Bounds3 b =
      static_cast<const Shape*>(args->geometryUserPtr)->primitive_bounds(args->primID);
  *args->bounds_o = {b.low.x, b.low.y, b.low.z, 0, b.high.x, b.high.y, b.high.z, 0};
}

/// Only single rays are traced, so packets have size one and a plain layout.
void analytic_intersect(const RTCIntersectFunctionNArguments* args) {
  if (args->valid[0] == 0) return;
  auto& query = *reinterpret_cast<RTCRayHit*>(args->rayhit);
  PrimitiveHit hit;
  const auto* shape = static_cast<const Shape*>(args->geometryUserPtr);
  const ShapeRay local = shape_ray(query.ray, *args->context);
  if (!shape->intersect(local.ray, args->primID, hit)) return;
  query.ray.tfar = std::min(hit.t / local.scale, query.ray.tfar);
  query.hit.u = hit.coordinates.x;
  query.hit.v = hit.coordinates.y;
  query.hit.primID = args->primID;
  query.hit.geomID = args->geomID;
  query.hit.instID[0] = args->context->instID[0];
}

void analytic_occluded(const RTCOccludedFunctionNArguments* args) {
  if (args->valid[0] == 0) return;
  auto& query = *reinterpret_cast<RTCRay*>(args->ray);
  PrimitiveHit hit;
  const auto* shape = static_cast<const Shape*>(args->geometryUserPtr);
  const ShapeRay local = shape_ray(query, *args->context);
  if (shape->intersect(local.ray, args->primID, hit)) query.tfar = -kInfinity;
}

RTCGeometry mesh_geometry(RTCDevice device, const TriangleMesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  // Embree loads 16 bytes per vertex, and thus reads past the end of a packed array. It therefore
  // gets a copy, which it pads itself. Indices are loaded as they are.
  constexpr std::size_t stride = sizeof(Point3);
  static_assert(stride == 3 * sizeof(float));
  void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                           stride, mesh.positions.size());
  if (vertices != nullptr) {
    std::memcpy(vertices, mesh.positions.data(), stride * mesh.positions.size());
  }
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                             mesh.triangles.data(), 0, sizeof(mesh.triangles[0]),
                             mesh.triangles.size());
  return geometry;
}

RTCGeometry analytic_geometry(RTCDevice device, const Shape& shape) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, shape.primitive_count());
  rtcSetGeometryUserData(geometry, const_cast<Shape*>(&shape));
  rtcSetGeometryBoundsFunction(geometry, analytic_bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, analytic_intersect);
  rtcSetGeometryOccludedFunction(geometry, analytic_occluded);
  return geometry;
}

RTCGeometry instance_geometry(RTCDevice device, RTCScene group, const Transform& to_world) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry, group);
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, to_world.matrix().data());
  return geometry;
}

/// Commits `geometry` and hands it over to `scene`.
void attach(RTCScene scene, RTCGeometry geometry, std::size_t id) {
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, static_cast<unsigned>(id));
  rtcReleaseGeometry(geometry);
}

/// Embree flushes denormal numbers to zero while it builds. If the first TBB task of a thread ran
/// in the build, TBB would use this mode for all later tasks of the thread, and the bits of a
/// render would depend on whether TBB was used before. A separate arena prevents this.
void commit(RTCScene scene) {
  tbb::task_arena arena;
  arena.execute([&] { rtcJoinCommitScene(scene); });
}

/// Stores the first error message of a build.
void note_error(void* first, RTCError, const char* message) {
  auto& text = *static_cast<std::string*>(first);
  if (text.empty()) text = message != nullptr && *message != '\0' ? message : "unknown reason";
}

/// Out of line, so that hits on other materials only pay for the test.
[[gnu::noinline]] void add_tangents(const Shape& shape, SurfacePoint& point) {
  point.set_tangents(shape.uv_tangents(point));
}

}  // namespace

void Scene::Accelerator::Release::operator()(RTCDeviceTy* device) const {
  rtcReleaseDevice(device);
}

void Scene::Accelerator::Release::operator()(RTCSceneTy* scene) const {
  rtcReleaseScene(scene);
}

Scene::Accelerator::Accelerator(const SceneParts& parts) : device_(rtcNewDevice(nullptr)) {
  if (device_ == nullptr) {
    throw RunError("Embree does not start (error " + std::to_string(rtcGetDeviceError(nullptr)) +
                   ")");
  }
  try {
    build(parts);
  } catch (...) {
    abandon();
    throw;
  }
}

void Scene::Accelerator::build(const SceneParts& parts) {
  std::string error;
  rtcSetDeviceErrorFunction(device_.get(), note_error, &error);
  scene_ = scene_of(parts.objects);
  world_objects_ = static_cast<std::uint32_t>(geometries_.size());
  add_instances(parts);
  commit(scene_.get());
  rtcSetDeviceErrorFunction(device_.get(), nullptr, nullptr);
  if (!error.empty()) throw RunError("Embree cannot build the scene: " + error);
}

void Scene::Accelerator::abandon() noexcept {
  rtcSetDeviceErrorFunction(device_.get(), nullptr, nullptr);
  for (EmbreeScene& group : groups_) static_cast<void>(group.release());
  static_cast<void>(scene_.release());
  static_cast<void>(device_.release());
}

Scene::Accelerator::EmbreeScene Scene::Accelerator::scene_of(
    const std::vector<SceneObject>& objects) {
  EmbreeScene scene(rtcNewScene(device_.get()));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_HIGH);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const Geometry known{objects[i].shape->mesh(), objects[i].shape.get(),
                         objects[i].bsdf->needs_tangents()};
    attach(scene.get(),
           known.mesh != nullptr ? mesh_geometry(device_.get(), *known.mesh)
                                 : analytic_geometry(device_.get(), *known.shape),
           i);
    geometries_.push_back(known);
  }
  return scene;
}

void Scene::Accelerator::add_instances(const SceneParts& parts) {
  std::vector<std::uint32_t> first_objects;
  for (const SceneGroup& group : parts.groups) {
    first_objects.push_back(static_cast<std::uint32_t>(geometries_.size()));
    groups_.push_back(scene_of(group.objects));
    commit(groups_.back().get());
  }
  instances_.reserve(parts.instances.size());
  for (const SceneInstance& instance : parts.instances) {
    RTCScene group = groups_[instance.group].get();
    attach(scene_.get(), instance_geometry(device_.get(), group, instance.to_world),
           world_objects_ + instances_.size());
    instances_.push_back({Placement(instance.to_world), first_objects[instance.group]});
  }
}

Scene::Accelerator::~Accelerator() = default;

inline float Scene::Accelerator::intersect(const Ray& ray, SurfacePoint& point) const {
  RTCRayHit query;
  query.ray = to_embree(ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  find_nearest(scene_.get(), query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return kInfinity;
  const float t = query.ray.tfar;
  if (query.hit.instID[0] != RTC_INVALID_GEOMETRY_ID) {
    instance_point(ray, query, point);
    return t;
  }
  const Geometry& geometry = geometries_[query.hit.geomID];
  // Constructed in place: copying this many small fields would stall on their stores.
  if (geometry.mesh != nullptr) {
    ::new (&point)
        SurfacePoint(geometry.mesh->surface_point(query.hit.primID, query.hit.u, query.hit.v));
  } else {
    ::new (&point) SurfacePoint(geometry.shape->surface_point(
        ray, {.t = t, .coordinates = {query.hit.u, query.hit.v}, .primitive = query.hit.primID}));
  }
  point.object = query.hit.geomID;
  if (geometry.needs_tangents) [[unlikely]]
    add_tangents(*geometry.shape, point);
  return t;
}

[[gnu::noinline]] void Scene::Accelerator::instance_point(const Ray& ray, const RTCRayHit& query,
                                                          SurfacePoint& point) const {
  const Instance& instance = instances_[query.hit.instID[0] - world_objects_];
  const std::uint32_t object = instance.first_object + query.hit.geomID;
  const Geometry& geometry = geometries_[object];
  const std::uint32_t primitive = query.hit.primID;
  const Vec2 b{query.hit.u, query.hit.v};
  SurfacePoint local;
  PlacementError error;
  if (geometry.mesh != nullptr) {
    local = geometry.mesh->surface_point(primitive, b.x, b.y);
    error = instance.placement.error_at(local);
    local.position = geometry.mesh->position_off_edges(primitive, b.x, b.y, error.margin);
  } else {
    const Placement::LocalRay to_shape = instance.placement.to_local(ray);
    local = geometry.shape->surface_point(
        to_shape.ray,
        {.t = to_shape.scale * query.ray.tfar, .coordinates = b, .primitive = primitive});
    error = instance.placement.error_at(local);
  }
  ::new (&point) SurfacePoint(instance.placement.to_world(local, error.world));
  point.object = object;
  if (geometry.needs_tangents) {
    point.set_tangents(instance.placement.to_world(geometry.shape->uv_tangents(local)));
  }
}

inline bool Scene::Accelerator::occluded(const Ray& ray) const {
  RTCRay query = to_embree(ray);
  find_any(scene_.get(), query);
  return query.tfar == -kInfinity;  // Embree's mark for an occluded ray
}

// Scene's two ray queries are defined here, so that the accelerator's functions are inlined in
// them.

float Scene::intersect(const Ray& ray, SurfacePoint& point) const {
  return accelerator_->intersect(ray, point);
}

bool Scene::occluded(const Ray& ray) const {
  return accelerator_->occluded(ray);
}

}  // namespace pharos
