// Groups placed in the world: rays must find the same surfaces as if these were placed one by one.

#include <fstream>
#include <unistd.h>

#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <pharos/core/error.h>
#include <pharos/scene/scene.h>

#include "fixtures.h"
#include "scene_fixtures.h"

namespace pharos {
namespace {

using Vec3d = std::array<double, 3>;

double dot(const Vec3d& a, const Vec3d& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The unit ball about the origin, as an analytic shape. It requires directions of unit length.
class Ball : public Shape {
 public:
  Bounds3 bounds() const override { return {{-1, -1, -1}, {1, 1, 1}}; }
  float area() const override { return 4 * kPi; }
  bool intersect(const Ray& ray, std::uint32_t, PrimitiveHit& hit) const override {
    for (const double root : roots(ray)) {
      const float t = static_cast<float>(root);
      if (!(t > 0 && t < ray.t_max)) continue;
      hit.t = t;
      return true;
    }
    return false;
  }
  SurfacePoint surface_point(const Ray& ray, const PrimitiveHit& hit) const override {
    const auto both = roots(ray);
    const double t = std::abs(both[0] - hit.t) <= std::abs(both[1] - hit.t) ? both[0] : both[1];
    SurfacePoint p;
    for (int i = 0; i < 3; ++i) {
      p.position[i] = static_cast<float>(double{ray.origin[i]} + t * ray.direction[i]);
    }
    p.position = p.normal = normalize(p.position);
    p.shading = Frame::from_normal(p.normal);
    p.error = 4 * std::numeric_limits<float>::epsilon();
    return p;
  }
  ShapeSample sample(Vec2) const override { return {}; }

 private:
  static std::array<double, 2> roots(const Ray& ray) {
    CHECK(length(ray.direction) == doctest::Approx(1));
    const Vec3d o{ray.origin.x, ray.origin.y, ray.origin.z};
    const Vec3d d{ray.direction.x, ray.direction.y, ray.direction.z};
    const double a = dot(d, d), along = -dot(o, d) / a;
    const Vec3d near{o[0] + along * d[0], o[1] + along * d[1], o[2] + along * d[2]};
    const double half = std::sqrt(std::max(0.0, 1 - dot(near, near)) / a);
    if (dot(near, near) > 1) return {-1, -1};
    return {along - half, along + half};
  }
};

Transform sheared() {
  return Transform({{{1.5f, 0.4f, 0.2f, 0.3f}, {0, 0.8f, -0.3f, 1}, {0.1f, 0.2f, 1.1f, -2}}});
}

std::vector<Transform> maps() {
  const Transform even = Transform::translate({3, -4, 5}) * Transform::rotate({1, 2, 3}, 50) *
                         Transform::scale({2.5f, 2.5f, 2.5f});
  return {Transform(),
          Transform::translate({-200, 100, 40}),
          even,
          sheared(),
          even * Transform::scale({1, -1, 1}),
          sheared() * Transform::scale({-1, 0.2f, 3})};
}

/// Transforms a mesh like a shape does: the outer side stays the outer side.
TriangleMesh transformed(TriangleMesh mesh, const Transform& map) {
  for (Point3& p : mesh.positions) p = map.point(p);
  for (Vec3& n : mesh.normals) n = normalize(map.normal(n));
  if (map.flips_handedness()) {
    for (auto& corner : mesh.triangles) std::swap(corner[1], corner[2]);
  }
  return mesh;
}

TriangleMesh painted_ball() {
  TriangleMesh mesh = test::bumpy_ball(16, 1, {});
  for (const Point3& p : mesh.positions) mesh.uvs.push_back({p.x + 2 * p.y, p.z});
  return mesh;
}

SceneParts group_of(std::vector<Ref<Shape>> shapes, const std::vector<Transform>& places) {
  SceneParts parts;
  parts.groups.emplace_back();
  for (Ref<Shape>& shape : shapes) parts.groups[0].objects.push_back(test::object_of(shape));
  for (const Transform& place : places) parts.instances.push_back({0, place});
  return parts;
}

Ref<Shape> shape_of(TriangleMesh mesh) {
  return std::make_shared<const test::MeshShape>(std::move(mesh));
}

/// Returns a ray from outside towards a random point of a ball of radius 1.3 about the local
/// origin.
Ray random_ray(RandomStream& random, const Transform& map) {
  const Point3 origin = map.point(3 * test::random_direction(random));
  const Point3 target = map.point(1.3f * random.next_1d() * test::random_direction(random));
  return {origin, normalize(target - origin)};
}

TEST_CASE("an instance is met like the same meshes placed one by one") {
  const TriangleMesh ball = painted_ball(), square = test::square_at(1.05f);
  for (const Transform& map : maps()) {
    SceneParts parts = group_of({shape_of(ball), shape_of(square)}, {map});
    parts.objects.push_back(test::object_of(shape_of(test::square_at(1e4f))));
    const Scene instanced(std::move(parts));
    const Scene placed(
        test::parts_of({test::square_at(1e4f), transformed(ball, map), transformed(square, map)}));
    RandomStream random(1);
    int hits = 0, other_triangles = 0;
    for (int i = 0; i < 5000; ++i) {
      const Ray ray = random_ray(random, map);
      SurfacePoint p, q;
      const float t = instanced.intersect(ray, p), u = placed.intersect(ray, q);
      CHECK(instanced.occluded(ray) == (t < kInfinity));
      if (t == kInfinity && u == kInfinity) continue;
      ++hits;
      if (p.object != q.object || p.primitive != q.primitive) {
        ++other_triangles;  // the ray meets an edge
        continue;
      }
      const float cosine = abs_dot(ray.direction, q.normal);
      const float apart = 2 * (p.error + q.error) / std::max(cosine, 1e-3f);
      CHECK(std::abs(t - u) < apart);
      // Close to edges, both positions are moved along the triangle.
      const float moved = 4 * kEdgeMargin * (p.error + q.error);
      CHECK(length(p.position - q.position) < apart + moved);
      CHECK(abs_dot(p.position - q.position, q.normal) < p.error + q.error);
      // Vertices that were placed one by one are rounded, which causes the largest difference.
      CHECK(length(p.normal - q.normal) < 1e-5f + 100 * q.error);
      CHECK(dot(p.shading.n, p.normal) > 0);
      CHECK(length(cross(p.shading.s, p.shading.t) - p.shading.n) < 1e-5f);
      const Vec2 uv_apart = p.uv - q.uv;
      if (p.object == 1) CHECK(std::abs(uv_apart.x) + std::abs(uv_apart.y) < 1e-4f + 20 * apart);
    }
    CHECK(hits > 2500);
    CHECK(other_triangles < hits / 200);
  }
}

TEST_CASE("shading frames of an instance are those of the group, mapped as normals and tangents") {
  const Scene local(test::parts_of({painted_ball()}));
  for (const Transform& map : maps()) {
    const Scene scene(group_of({shape_of(painted_ball())}, {map}));
    RandomStream random(4);
    for (int i = 0; i < 2000; ++i) {
      const Ray ray = random_ray(random, map);
      const Ray local_ray{map.inverse_point(ray.origin),
                          normalize(map.inverse_vector(ray.direction))};
      SurfacePoint p, q;
      const bool both =
          scene.intersect(ray, p) < kInfinity && local.intersect(local_ray, q) < kInfinity;
      if (!both || p.primitive != q.primitive) continue;
      const Vec3 normal = normalize(map.normal(q.shading.n));
      const float side = std::copysign(1.0f, dot(normal, p.normal));
      CHECK(length(p.shading.n - side * normal) < 2e-3f);
      const Vec3 tangent = map.vector(q.shading.s);
      CHECK(std::abs(dot(p.shading.t, tangent)) < 2e-3f * length(tangent));
      CHECK(dot(p.shading.s, tangent) > -1e-3f);
      CHECK(length(cross(p.shading.s, p.shading.t) - p.shading.n) < 1e-5f);
    }
  }
}

TEST_CASE("the objects of groups follow those of the world and are shared by all instances") {
  SceneParts parts = group_of({shape_of(test::square_at(0)), shape_of(test::square_at(1))},
                              {Transform(), Transform::translate({10, 0, 0})});
  parts.groups.insert(parts.groups.begin(),
                      SceneGroup{{test::object_of(shape_of(test::square_at(2)))}});
  for (SceneInstance& instance : parts.instances) instance.group = 1;
  parts.instances.push_back({0, Transform::translate({0, 20, 0})});
  parts.objects.push_back(test::object_of(shape_of(test::square_at(-7))));
  parts.objects[0].emitter = std::make_shared<const test::PlacedEmitter>(true);
  std::vector<const Bsdf*> bsdfs{parts.objects[0].bsdf.get(), parts.groups[0].objects[0].bsdf.get(),
                                 parts.groups[1].objects[0].bsdf.get(),
                                 parts.groups[1].objects[1].bsdf.get()};
  const Scene scene(std::move(parts));
  REQUIRE(scene.objects().size() == 4);
  CHECK(scene.primitive_count() == 8);
  CHECK(scene.bounds().low == Point3{-1, -1, -7});
  CHECK(scene.bounds().high == Point3{11, 21, 2});
  const auto object_under = [&](float x, float y) {
    SurfacePoint p;
    CHECK(scene.intersect({{x, y, 5}, {0, 0, -1}}, p) < kInfinity);
    CHECK(&scene.bsdf(p) == bsdfs[p.object]);
    CHECK((scene.light_at(p) != nullptr) == (p.object == 0));
    return p.object;
  };
  CHECK(object_under(0.5f, 0.2f) == 3);
  CHECK(object_under(10.5f, 0.2f) == 3);
  CHECK(object_under(0.5f, 20.2f) == 1);
  SurfacePoint p;
  CHECK(scene.intersect({{0.5f, 0.2f, -3}, {0, 0, -1}}, p) == doctest::Approx(4));
  CHECK(p.object == 0);
  CHECK(scene.intersect({{10.5f, 0.2f, 0.5f}, {0, 0, -1}}, p) == doctest::Approx(0.5));
  CHECK(p.object == 2);
}

TEST_CASE("an analytic ball in an instance is the ellipsoid that the map makes of it") {
  for (const Transform& map : maps()) {
    const Scene scene(group_of({std::make_shared<const Ball>()}, {map}));
    RandomStream random(2);
    int hits = 0;
    for (int i = 0; i < 3000; ++i) {
      Ray ray = random_ray(random, map);
      SurfacePoint p;
      const float t = scene.intersect(ray, p);
      CHECK(scene.occluded(ray) == (t < kInfinity));
      if (t == kInfinity) continue;
      ++hits;
      const float cosine = std::max(abs_dot(ray.direction, p.normal), 1e-3f);
      CHECK(length(ray.at(t) - p.position) < 4 * p.error / cosine);
      const Vec3 local = map.inverse_point(p.position);
      CHECK(std::abs(length(local) - 1) < p.error * length(map.normal(local)));
      CHECK(dot(p.normal, normalize(map.normal(local))) == doctest::Approx(1));
      CHECK(dot(p.normal, ray.direction) < 0.01f);  // the ray comes from outside, mirrored or not
      ray.t_max = t * 1.001f;
      CHECK(scene.intersect(ray, p) == t);
      CHECK(scene.occluded(ray));
      ray.t_max = t * 0.999f;
      CHECK(scene.intersect(ray, p) == kInfinity);
      CHECK_FALSE(scene.occluded(ray));
    }
    CHECK(hits > 1000);
  }
}

TEST_CASE("media lie on the sides of an instance where the group has them, mirrored or not") {
  const auto inside = std::make_shared<const test::ClearMedium>();
  for (const float mirror : {1.0f, -1.0f}) {
    SceneParts parts = group_of({shape_of(test::square_at(0))}, {Transform::scale({mirror, 2, 3})});
    parts.groups[0].objects[0].interior = inside;
    const Scene scene(std::move(parts));
    CHECK(scene.has_media());
    SurfacePoint p;
    REQUIRE(scene.intersect({{0.1f, 0.2f, 5}, {0, 0, -1}}, p) == doctest::Approx(5));
    CHECK(p.normal.z == 1);
    CHECK(scene.medium_after(p, {0, 0, -1}, nullptr) == inside.get());
    CHECK(scene.medium_after(p, {0, 0, 1}, inside.get()) == nullptr);
  }
}

struct Faults {
  int leaks = 0, self_hits = 0, blocked = 0;
};

/// Walks from wall to wall inside a closed surface about the local origin. If `convex` is set, also
/// sends rays away from the outer side, which must meet nothing.
Faults walk(const Scene& scene, const Transform& map, bool convex) {
  Faults faults;
  RandomStream random(3);
  const Point3 start = map.point({});
  Ray ray{start, test::random_direction(random)};
  std::uint32_t left = ~0u;
  for (int i = 0; i < 20'000; ++i) {
    SurfacePoint p;
    if (scene.intersect(ray, p) == kInfinity) {
      ++faults.leaks;
      left = ~0u;
      ray = {start, test::random_direction(random)};
      continue;
    }
    if (!convex && p.primitive == left) ++faults.self_hits;
    left = p.primitive;
    const Vec3 local = warp::cosine_hemisphere_from_square(random.next_2d());
    const Vec3 out = normalize(Frame::from_normal(p.normal).to_world(local));
    if (convex && scene.occluded({p.origin_towards(out), out})) ++faults.blocked;
    ray.direction = normalize(Frame::from_normal(-p.normal).to_world(local));
    ray.origin = p.origin_towards(ray.direction);
  }
  return faults;
}

TEST_CASE("rays neither leak from instances nor meet the surface they leave, near or far") {
  const Transform turned = Transform::rotate({1, 2, 3}, 40);
  for (const float scale : {1e-4f, 1.0f, 1e4f}) {
    for (const Vec3 offset : {Vec3{0, 0, 0}, Vec3{-200, 210, 190}, Vec3{1000, -700, 500}}) {
      for (const Vec3 stretch : {Vec3{1, 1, 1}, Vec3{-1, 1, 1}, Vec3{1, 4, 0.5f}}) {
        const Transform map = Transform::translate(scale * offset) * turned *
                              Transform::scale(scale * stretch) * turned;
        INFO("scale ", scale, ", offset ", offset.x, ", stretched by ", stretch.x, " ", stretch.y);
        const Faults mesh =
            walk(Scene(group_of({shape_of(test::bumpy_ball(20, 1, {}))}, {map})), map, false);
        CHECK(mesh.leaks == 0);
        CHECK(mesh.self_hits == 0);
        const Faults ball =
            walk(Scene(group_of({std::make_shared<const Ball>()}, {map})), map, true);
        CHECK(ball.leaks == 0);
        CHECK(ball.blocked == 0);
      }
    }
  }
}

/// Returns the resident memory of this process [MiB].
double resident_mebibytes() {
  std::ifstream statm("/proc/self/statm");
  std::size_t whole = 0, resident = 0;
  statm >> whole >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

TEST_CASE("ten thousand instances cost little next to the triangles that they show") {
  const TriangleMesh ball = test::bumpy_ball(50, 1, {});  // 9,800 triangles
  std::vector<Transform> places;
  for (int i = 0; i < 10'000; ++i) {
    places.push_back(Transform::translate(
        {3.0f * static_cast<float>(i % 100), 0, 3.0f * static_cast<float>(i / 100)}));
  }
  SceneParts parts = group_of({shape_of(ball)}, places);
  const double before = resident_mebibytes();
  const Scene scene(std::move(parts));
  const double memory = resident_mebibytes() - before;
  MESSAGE("98 million triangles in ", memory, " MiB");
  CHECK(memory < 200);  // placed one by one, they take more than 10,000 MiB
  CHECK(scene.primitive_count() == ball.triangles.size());
  SurfacePoint p;
  CHECK(scene.intersect({{297, 9, 150}, {0, -1, 0}}, p) == doctest::Approx(8).epsilon(0.02));
}

TEST_CASE("which of several coinciding instances is hit does not depend on the number of threads") {
  const auto seen = [](int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    std::unique_ptr<const Scene> scene;
    arena.execute([&] {
      std::vector<Transform> places;
      for (int i = 0; i < 600; ++i) {
        places.push_back(Transform::translate({0.2f * static_cast<float>(i / 3), 0, 0}));
      }
      SceneParts parts =
          group_of({shape_of(test::square_at(0)), shape_of(test::square_at(0))}, places);
      parts.groups.push_back(parts.groups[0]);
      for (std::size_t i = 0; i < places.size(); i += 2) parts.instances[i].group = 1;
      scene = std::make_unique<const Scene>(std::move(parts));
    });
    RandomStream random(9);
    std::vector<std::uint32_t> objects;
    std::vector<float> values;
    for (int i = 0; i < 3000; ++i) {
      const Point3 target{40 * random.next_1d(), random.next_1d() - 0.5f, 0};
      const Point3 origin = target + Vec3{random.next_1d(), random.next_1d(), 1};
      SurfacePoint p;
      scene->intersect({origin, normalize(target - origin)}, p);
      objects.push_back(p.object);
      values.insert(values.end(), {p.position.x, p.position.y, p.position.z, p.error});
    }
    return std::pair(objects, values);
  };
  const auto alone = seen(1);
  CHECK(std::count(alone.first.begin(), alone.first.end(), 0u) > 300);
  CHECK(std::count(alone.first.begin(), alone.first.end(), 0u) < 2700);
  CHECK(alone == seen(2));
  CHECK(alone == seen(7));
}

TEST_CASE("an instance beyond what a float can hold is refused") {
  SceneParts parts =
      group_of({shape_of(test::square_at(0))}, {Transform::translate({3e38f, 0, 0})});
  parts.instances[0].to_world = parts.instances[0].to_world * Transform::scale({1e38f, 1, 1});
  CHECK(test::input_error([&] { Scene scene(parts); }).find("beyond what a float") !=
        std::string::npos);
}

TEST_CASE("groups that are empty or stand nowhere do no harm") {
  SceneParts parts = group_of({shape_of(test::square_at(0))}, {});
  parts.groups.emplace_back();
  parts.instances.push_back({1, Transform()});
  const Scene scene(std::move(parts));
  SurfacePoint p;
  CHECK(scene.intersect({{0.5f, 0.2f, 5}, {0, 0, -1}}, p) == kInfinity);
  CHECK(scene.bounds().empty());
  CHECK(scene.objects().size() == 1);
}

}  // namespace
}  // namespace pharos
