#include <atomic>
#include <limits>
#include <thread>

#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <pharos/core/parallel.h>
#include <pharos/scene/scene.h>

#include "scene_fixtures.h"

namespace pharos {
namespace {

/// A slab between the heights -1 and 0. Rays meet it from above or from within.
class Slab : public Shape {
 public:
  Bounds3 bounds() const override { return {{-1, -1, -1}, {1, 1, 0}}; }
  float area() const override { return 8; }
  std::uint32_t primitive_count() const override { return 2; }  // upper and lower side
  Bounds3 primitive_bounds(std::uint32_t i) const override {
    const float z = height(i);
    return {{-1, -1, z}, {1, 1, z}};
  }
  bool intersect(const Ray& ray, std::uint32_t i, PrimitiveHit& hit) const override {
    const float t = (height(i) - ray.origin.z) / ray.direction.z;
    if (!(t > 0 && t < ray.t_max)) return false;
    hit.t = t;
    hit.coordinates = {ray.at(t).x, ray.at(t).y};
    return true;
  }
  SurfacePoint surface_point(const Ray&, const PrimitiveHit& hit) const override {
    SurfacePoint p;
    p.position = {hit.coordinates.x, hit.coordinates.y, height(hit.primitive)};
    p.normal = {0, 0, hit.primitive == 0 ? 1.0f : -1.0f};
    p.primitive = hit.primitive;
    return p;
  }
  ShapeSample sample(Vec2) const override { return {}; }

 private:
  static float height(std::uint32_t i) { return i == 0 ? 0.0f : -1.0f; }
};

/// Returns `copies` copies of a mesh of small triangles at random places in the unit cube.
std::vector<TriangleMesh> soup(int triangles, int copies) {
  TriangleMesh mesh;
  RandomStream random(11);
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(triangles); ++i) {
    const Point3 center{random.next_1d(), random.next_1d(), random.next_1d()};
    for (int k = 0; k < 3; ++k) {
      mesh.positions.push_back(center + 0.1f * test::random_direction(random));
    }
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return std::vector<TriangleMesh>(static_cast<std::size_t>(copies), mesh);
}

Ray random_ray(RandomStream& random) {
  const Point3 origin = Point3{0.5f, 0.5f, 0.5f} + 2 * test::random_direction(random);
  const Point3 target{random.next_1d(), random.next_1d(), random.next_1d()};
  return {origin, normalize(target - origin)};
}

TEST_CASE("the nearest surface is found, with its object and primitive") {
  const Scene scene(test::parts_of({test::square_at(0), test::square_at(2), test::square_at(1)}));
  SurfacePoint p;
  CHECK(scene.intersect({{0.5f, -0.5f, 5}, {0, 0, -1}}, p) == doctest::Approx(3));
  CHECK(p.object == 1);
  CHECK(p.primitive == 0);
  CHECK(length(p.position - Point3{0.5f, -0.5f, 2}) < 1e-6f);
  CHECK(scene.intersect({{-0.5f, 0.5f, 1.5f}, {0, 0, -1}}, p) == doctest::Approx(0.5));
  CHECK(p.object == 2);
  CHECK(p.primitive == 1);
  CHECK(scene.intersect({{-0.5f, 0.5f, -3}, {0, 0, 1}}, p) == doctest::Approx(3));
  CHECK(p.object == 0);
  CHECK(p.normal.z == 1);  // the normal of the surface, not of the side that was met
  CHECK(scene.intersect({{3, 0, 5}, {0, 0, -1}}, p) == kInfinity);
  CHECK(scene.primitive_count() == 6);
}

TEST_CASE("only what lies before the ray's end counts") {
  const Scene scene(test::parts_of({test::square_at(0)}));
  SurfacePoint p;
  const Point3 above{0.5f, 0, 1};
  CHECK(scene.intersect({above, {0, 0, -1}, 0.999f}, p) == kInfinity);
  CHECK(scene.intersect({above, {0, 0, -1}, 1.001f}, p) == doctest::Approx(1));
  CHECK_FALSE(scene.occluded({above, {0, 0, -1}, 0.999f}));
  CHECK(scene.occluded({above, {0, 0, -1}, 1.001f}));
  CHECK(scene.occluded({above, {0, 0, -1}}));
  CHECK_FALSE(scene.occluded({above, {0, 0, -1}, -1}));
  CHECK_FALSE(scene.occluded({above, {0, 0, 1}}));
}

TEST_CASE("occlusion agrees with intersection") {
  const Scene scene(test::parts_of(soup(500, 1)));
  RandomStream random(1);
  int hits = 0;
  for (int i = 0; i < 5000; ++i) {
    Ray ray = random_ray(random);
    SurfacePoint p;
    const float t = scene.intersect(ray, p);
    REQUIRE(scene.occluded(ray) == (t < kInfinity));
    if (t == kInfinity) continue;
    ++hits;
    CHECK(length(ray.at(t) - p.position) < 1e-5f);
    ray.t_max = 0.999f * t;
    CHECK_FALSE(scene.occluded(ray));
  }
  CHECK(hits > 1000);
}

TEST_CASE("analytic shapes answer primitive by primitive among meshes") {
  SceneParts parts = test::parts_of({test::square_at(-0.5f)});
  parts.objects.push_back(test::object_of(std::make_shared<const Slab>()));
  const Scene scene(std::move(parts));
  SurfacePoint p;
  CHECK(scene.primitive_count() == 4);
  CHECK(scene.intersect({{0.25f, 0.5f, 1}, {0, 0, -1}}, p) == 1);
  CHECK(p.object == 1);
  CHECK(p.primitive == 0);
  CHECK(p.position == Point3{0.25f, 0.5f, 0});
  CHECK(scene.intersect({{0.25f, 0.5f, -2}, {0, 0, 1}}, p) == 1);
  CHECK(p.primitive == 1);
  CHECK(scene.intersect({{0.25f, 0.5f, -0.1f}, {0, 0, -1}}, p) == doctest::Approx(0.4));
  CHECK(p.object == 0);
  CHECK(scene.occluded({{0.25f, 0.5f, -2}, {0, 0, 1}, 1.5f}));
  CHECK_FALSE(scene.occluded({{0.25f, 0.5f, -2}, {0, 0, 1}, 0.5f}));
}

TEST_CASE("rays neither leak from a closed mesh nor meet the triangle they leave") {
  for (const float scale : {1e-4f, 1.0f, 1e4f}) {
    for (const Vec3 offset : {Vec3{0, 0, 0}, Vec3{-200, 210, 190}}) {
      const Scene scene(test::parts_of({test::bumpy_ball(24, scale, offset)}));
      RandomStream random(3);
      Ray ray{scale * offset, {0, 0, 1}};
      int leaks = 0, self_hits = 0;
      std::uint32_t left = ~0u;
      for (int i = 0; i < 50'000; ++i) {
        SurfacePoint p;
        if (scene.intersect(ray, p) == kInfinity) {
          ++leaks;
          ray.origin = scale * offset;
          continue;
        }
        if (p.primitive == left) ++self_hits;
        left = p.primitive;
        const Vec3 local = warp::cosine_hemisphere_from_square(random.next_2d());
        ray.direction = normalize(Frame::from_normal(-p.normal).to_world(local));
        ray.origin = p.origin_towards(ray.direction);
      }
      CHECK(leaks == 0);
      CHECK(self_hits == 0);
    }
  }
}

TEST_CASE("scaling a scene by a power of two scales every hit exactly") {
  const std::vector<TriangleMesh> meshes = {soup(2000, 1)[0],
                                            test::bumpy_ball(20, 1, {0.5f, 0.5f, 0})};
  const Scene scene(test::parts_of(meshes));
  for (const float scale : {0x1p-14f, 0x1p13f}) {
    std::vector<TriangleMesh> scaled_meshes = meshes;
    for (TriangleMesh& mesh : scaled_meshes) {
      for (Point3& p : mesh.positions) p = scale * p;
    }
    const Scene scaled(test::parts_of(scaled_meshes));
    RandomStream random(5);
    int wrong = 0;
    for (int i = 0; i < 20'000; ++i) {
      const Ray ray = random_ray(random);
      SurfacePoint p, q;
      const float t = scene.intersect(ray, p);
      const float u = scaled.intersect({scale * ray.origin, ray.direction}, q);
      if (t == kInfinity && u == kInfinity) continue;
      const bool same = u == scale * t && q.position == scale * p.position &&
                        q.error == scale * p.error && q.normal == p.normal && q.uv == p.uv &&
                        q.shading.n == p.shading.n && q.object == p.object &&
                        q.primitive == p.primitive;
      if (!same) ++wrong;
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("which of several coinciding surfaces is hit does not depend on the number of threads") {
  const auto objects_hit = [](int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    std::unique_ptr<const Scene> scene;
    arena.execute([&] { scene = std::make_unique<const Scene>(test::parts_of(soup(3000, 40))); });
    RandomStream random(9);
    std::vector<std::uint32_t> objects;
    for (int i = 0; i < 5000; ++i) {
      SurfacePoint p;
      scene->intersect(random_ray(random), p);
      objects.push_back(p.object);
    }
    return objects;
  };
  const std::vector<std::uint32_t> alone = objects_hit(1);
  CHECK(alone == objects_hit(2));
  CHECK(alone == objects_hit(7));
}

TEST_CASE("building a scene does not make later tasks flush denormal numbers") {
  // A new thread, because the first use of TBB by a thread decides about its tasks.
  std::atomic<int> flushed = 0;
  std::thread([&] {
    const Scene scene(test::parts_of(soup(20'000, 1)));
    parallel_for(200, [&](std::size_t) {
      volatile float small = std::numeric_limits<float>::min();
      small = small / 2;
      if (small == 0) ++flushed;
    });
  }).join();
  CHECK(flushed == 0);
}

TEST_CASE("lights stand where their emitters were given, numbered objects first") {
  SceneParts parts = test::parts_of({test::square_at(0), test::square_at(1), test::square_at(2)});
  parts.objects[1].emitter = std::make_shared<const test::PlacedEmitter>(true);
  parts.emitters = {std::make_shared<const test::PlacedEmitter>(false)};
  parts.sensor = std::make_shared<const test::PointSensor>(Point3{0, 0, 50});
  const Scene scene(std::move(parts));
  using Placed = test::PlacedEmitter::PlacedLight;

  REQUIRE(scene.lights().size() == 2);
  const auto& area = dynamic_cast<const Placed&>(*scene.lights()[0]);
  CHECK(area.site.shape == scene.objects()[1].shape.get());
  CHECK(area.site.object == 1);
  const auto& sky = dynamic_cast<const Placed&>(*scene.lights()[1]);
  CHECK(sky.site.shape == nullptr);
  CHECK(sky.site.scene_center == Point3{0, 0, 1});  // the center of the geometry without the sensor
  CHECK(sky.site.scene_radius == doctest::Approx(std::sqrt(3.0)));
  REQUIRE(scene.environment_lights().size() == 1);
  CHECK(scene.environment_lights()[0] == 1);

  SurfacePoint p;
  p.object = 1;
  CHECK(scene.light_at(p) == &area);
  CHECK(scene.light_index(p) == 0);
  p.object = 2;
  CHECK(scene.light_at(p) == nullptr);
  CHECK(scene.light_index(p) == -1);
}

TEST_CASE("bounds hold geometry and sensor") {
  SceneParts parts = test::parts_of({test::square_at(0), test::square_at(2)});
  CHECK(Scene(parts).bounds().high == Point3{1, 1, 2});
  parts.sensor = std::make_shared<const test::PointSensor>(Point3{0, -7, 1});
  const Scene scene(parts);
  CHECK(scene.bounds().low == Point3{-1, -7, 0});
  CHECK(scene.bounds().high == Point3{1, 1, 2});
  CHECK(scene.sensor().position() == Point3{0, -7, 1});
}

TEST_CASE("media are known on both sides of the objects that bound them") {
  SceneParts parts = test::parts_of({test::square_at(0), test::square_at(1)});
  const auto inside = std::make_shared<const test::ClearMedium>();
  const auto around = std::make_shared<const test::ClearMedium>();
  CHECK_FALSE(Scene(parts).has_media());
  parts.objects[0].interior = inside;
  parts.medium = around;
  const Scene scene(parts);
  CHECK(scene.has_media());
  CHECK(scene.sensor_medium() == around.get());
  SurfacePoint p;
  p.normal = {0, 0, 1};
  CHECK(scene.medium_after(p, {0, 0, -1}, around.get()) == inside.get());
  CHECK(scene.medium_after(p, {0, 0, 1}, inside.get()) == nullptr);
  p.object = 1;  // this object bounds no medium
  CHECK(scene.medium_after(p, {0, 0, 1}, around.get()) == around.get());
}

TEST_CASE("an empty scene is a scene") {
  SceneParts parts;
  parts.emitters = {std::make_shared<const test::PlacedEmitter>(false)};
  const Scene scene(std::move(parts));
  SurfacePoint p;
  CHECK(scene.intersect({{0, 0, 0}, {0, 0, 1}}, p) == kInfinity);
  CHECK_FALSE(scene.occluded({{0, 0, 0}, {0, 0, 1}}));
  CHECK(scene.primitive_count() == 0);
  CHECK(scene.bounds().empty());
  const auto& sky = dynamic_cast<const test::PlacedEmitter::PlacedLight&>(*scene.lights()[0]);
  CHECK(sky.site.scene_radius > 0);
}

}  // namespace
}  // namespace pharos
