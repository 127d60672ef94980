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

/// Origins keep their distance themselves (SurfacePoint::origin_towards), so rays begin at 0.
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

void analytic_bounds(const RTCBoundsFunctionArguments* args) {
  const Bounds3 b =
      static_cast<const Shape*>(args->geometryUserPtr)->primitive_bounds(args->primID);
  *args->bounds_o = {b.low.x, b.low.y, b.low.z, 0, b.high.x, b.high.y, b.high.z, 0};
}

/// Only single rays are ever traced, so packets have size one and plain layout.
void analytic_intersect(const RTCIntersectFunctionNArguments* args) {
  if (args->valid[0] == 0) return;
  auto& query = *reinterpret_cast<RTCRayHit*>(args->rayhit);
  PrimitiveHit hit;
  const auto* shape = static_cast<const Shape*>(args->geometryUserPtr);
  if (!shape->intersect(from_embree(query.ray), args->primID, hit)) return;
  query.ray.tfar = hit.t;
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
  if (shape->intersect(from_embree(query), args->primID, hit)) query.tfar = -kInfinity;
}

RTCGeometry mesh_geometry(RTCDevice device, const TriangleMesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  // Embree loads 16 bytes a vertex, and so past the end of a packed array: it gets a copy that it
  // pads itself. Indices are loaded as they are.
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

/// Keeps the first message of a build.
void note_error(void* first, RTCError, const char* message) {
  auto& text = *static_cast<std::string*>(first);
  if (text.empty()) text = message != nullptr && *message != '\0' ? message : "unknown reason";
}

}  // namespace

void Scene::Accelerator::Release::operator()(RTCDeviceTy* device) const {
  rtcReleaseDevice(device);
}

void Scene::Accelerator::Release::operator()(RTCSceneTy* scene) const {
  rtcReleaseScene(scene);
}

Scene::Accelerator::Accelerator(const std::vector<SceneObject>& objects)
    : device_(rtcNewDevice(nullptr)) {
  if (device_ == nullptr) {
    throw RunError("Embree does not start (error " + std::to_string(rtcGetDeviceError(nullptr)) +
                   ")");
  }
  std::string error;
  rtcSetDeviceErrorFunction(device_.get(), note_error, &error);
  scene_.reset(rtcNewScene(device_.get()));
  rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_HIGH);
  for (const SceneObject& object : objects) {
    const Geometry known{object.shape->mesh(), object.shape.get()};
    RTCGeometry geometry = known.mesh != nullptr ? mesh_geometry(device_.get(), *known.mesh)
                                                 : analytic_geometry(device_.get(), *known.shape);
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene_.get(), geometry, static_cast<unsigned>(geometries_.size()));
    rtcReleaseGeometry(geometry);
    geometries_.push_back(known);
  }
  // Embree's builders split their work by the concurrency of the arena they run in, and the order
  // of primitives follows. An arena of one thread makes the hierarchy, and with it which of two
  // coinciding surfaces is hit, a function of the scene alone.
  tbb::task_arena one_thread(1);
  one_thread.execute([&] { rtcJoinCommitScene(scene_.get()); });
  rtcSetDeviceErrorFunction(device_.get(), nullptr, nullptr);
  if (!error.empty()) throw RunError("Embree cannot build the scene: " + error);
}

Scene::Accelerator::~Accelerator() = default;

inline float Scene::Accelerator::intersect(const Ray& ray, SurfacePoint& point) const {
  RTCRayHit query;
  query.ray = to_embree(ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  find_nearest(scene_.get(), query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return kInfinity;
  const Geometry& geometry = geometries_[query.hit.geomID];
  const float t = query.ray.tfar;
  // Built in place: copying this many small fields would wait for their stores.
  if (geometry.mesh != nullptr) {
    ::new (&point)
        SurfacePoint(geometry.mesh->surface_point(query.hit.primID, query.hit.u, query.hit.v));
  } else {
    ::new (&point) SurfacePoint(geometry.shape->surface_point(
        ray, {.t = t, .coordinates = {query.hit.u, query.hit.v}, .primitive = query.hit.primID}));
  }
  point.object = query.hit.geomID;
  return t;
}

inline bool Scene::Accelerator::occluded(const Ray& ray) const {
  RTCRay query = to_embree(ray);
  find_any(scene_.get(), query);
  return query.tfar == -kInfinity;  // how Embree marks a blocked ray
}

// The scene's two questions stand here so that nothing lies between them and Embree.

float Scene::intersect(const Ray& ray, SurfacePoint& point) const {
  return accelerator_->intersect(ray, point);
}

bool Scene::occluded(const Ray& ray) const {
  return accelerator_->occluded(ray);
}

}  // namespace pharos
