#include "raw_embree.h"

#if PHAROS_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <cstring>

namespace pharos::bench {

struct RawEmbree::Handles {
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = rtcNewScene(device);
};

RawEmbree::RawEmbree(const Scene& scene) : handles_(new Handles) {
  rtcSetSceneFlags(handles_->scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(handles_->scene, RTC_BUILD_QUALITY_HIGH);
  for (const SceneObject& object : scene.objects()) {
    const TriangleMesh* mesh = object.shape->mesh();
    if (mesh == nullptr) continue;
    RTCGeometry geometry = rtcNewGeometry(handles_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* positions =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(Point3), mesh->positions.size());
    std::memcpy(positions, mesh->positions.data(), mesh->positions.size() * sizeof(Point3));
    void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                              3 * sizeof(std::uint32_t), mesh->triangles.size());
    std::memcpy(triangles, mesh->triangles.data(),
                mesh->triangles.size() * 3 * sizeof(std::uint32_t));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(handles_->scene, geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(handles_->scene);
}

RawEmbree::~RawEmbree() {
  rtcReleaseScene(handles_->scene);
  rtcReleaseDevice(handles_->device);
  delete handles_;
}

std::size_t RawEmbree::intersect_all(std::span<const Ray> rays) const {
  std::size_t hits = 0;
  for (const Ray& ray : rays) {
    RTCRayHit query;
    query.ray = {ray.origin.x,
                 ray.origin.y,
                 ray.origin.z,
                 0,
                 ray.direction.x,
                 ray.direction.y,
                 ray.direction.z,
                 0,
                 ray.t_max,
                 ~0u,
                 0,
                 0};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if PHAROS_EMBREE_MAJOR >= 4
    rtcIntersect1(handles_->scene, &query);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(handles_->scene, &context, &query);
#endif
    hits += query.hit.geomID != RTC_INVALID_GEOMETRY_ID ? 1 : 0;
  }
  return hits;
}

}  // namespace pharos::bench
