#include <doctest/doctest.h>

#include <pharos/core/error.h>
#include <pharos/tests/fixtures.h>

#include "mapping_test_kit.h"

namespace pharos::mitsuba::test {
namespace {

/// Returns the entry of a shape.
std::string entry(std::string type, std::vector<Property> properties = {}) {
  return part(import_of({shape(std::move(type), std::move(properties))}), "scene.shapes.0");
}

/// Checks at many points of a shape that its outer side agrees with `outside(position)`.
template <class Outside>
void check_outside(const ObjectRef& given, const Outside& outside) {
  const LoadedConfig config = built(import_of({given}));
  REQUIRE(config.config.scene.objects.size() == 1);
  for (int i = 0; i < 100; ++i) {
    const Vec2 u{(static_cast<float>(i % 10) + 0.4f) / 10,
                 (static_cast<float>(i / 10) + 0.6f) / 10};
    const SurfacePoint point = config.config.scene.objects[0].shape->sample(u).point;
    CHECK(dot(point.normal, outside(point.position)) > 0);
  }
}

const Transform kMirrored = Transform::scale({-1, 1, 1});

}  // namespace

TEST_CASE("shapes: parameters and defaults") {
  CHECK(entry("rectangle") == "{ type: quad }");
  CHECK(entry("cube") == "{ type: box }");
  CHECK(entry("disk") == "{ type: disk }");
  CHECK(entry("sphere") == "{ type: sphere, radius: 1 }");
  CHECK(entry("sphere", {value("center", Triple{{1, 2, 3}}), value("radius", 0.5),
                         value("flip_normals", true)}) ==
        "{ type: sphere, flip_normals: true, center: [1, 2, 3], radius: 0.5 }");
  CHECK(entry("cylinder") == "{ type: cylinder, p0: [0, 0, 0], p1: [0, 0, 1], radius: 1 }");
  CHECK(entry("ply", {value("filename", "a.ply"), value("face_normals", true)}) ==
        "{ type: mesh, file: a.ply, normals: flat }");
  CHECK(entry("serialized",
              {value("filename", "a.serialized"), value("shape_index", std::int64_t{3})}) ==
        "{ type: mesh, file: a.serialized, normals: file_or_smooth, shape_index: 3 }");
  CHECK(entry("serialized", {value("filename", "a.serialized")}) ==
        "{ type: mesh, file: a.serialized, normals: file_or_smooth, shape_index: 0 }");
}

TEST_CASE("shapes: meshes without normals are smoothed unless faces are to be seen") {
  const pharos::test::TemporaryFolder folder;
  const std::string obj =
      folder.write("fold.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\n");
  const std::string ply = folder.write(
      "fold.ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 3 1\n");
  const auto is_flat = [](const char* type, const std::string& file, bool face_normals) {
    const Import import =
        import_of({shape(type, {value("filename", file), value("face_normals", face_normals)})});
    CHECK(notes(import).size() == 1);  // the missing camera
    const LoadedConfig config = built(import);
    const SurfacePoint point =
        config.config.scene.objects[0].shape->mesh()->surface_point(0, 0.3f, 0.3f);
    return dot(point.shading.n, point.normal) > 0.999f;
  };
  CHECK_FALSE(is_flat("obj", obj, false));
  CHECK_FALSE(is_flat("ply", ply, false));
  CHECK(is_flat("obj", obj, true));
  CHECK(is_flat("ply", ply, true));
}

TEST_CASE("shapes: to_world is written as its matrix, the identity not at all") {
  CHECK(entry("rectangle", {value("to_world", Transform::translate({1, 2, 3}))}) ==
        "{ type: quad, to_world: { matrix: [1, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3] } }");
  CHECK(entry("rectangle", {value("to_world", Transform())}) == "{ type: quad }");
}

TEST_CASE("shapes: outer sides, mirrored ones too") {
  const auto up = [](Point3) { return Vec3{0, 0, 1}; };
  const auto down = [](Point3) { return Vec3{0, 0, -1}; };
  const auto away = [](Point3 p) { return Vec3(p); };
  const auto from_axis = [](Point3 p) { return Vec3{p.x, p.y, 0}; };
  check_outside(shape("rectangle"), up);
  check_outside(shape("rectangle", {value("flip_normals", true)}), down);
  check_outside(shape("rectangle", {value("to_world", kMirrored)}), up);
  check_outside(shape("disk"), up);
  check_outside(shape("cube"), away);
  check_outside(shape("cube", {value("to_world", kMirrored)}), away);
  check_outside(shape("sphere", {value("to_world", kMirrored)}), away);
  check_outside(shape("cylinder"), from_axis);
}

TEST_CASE("shapes: what stands for a bsdf that is not stated") {
  CHECK(part(import_of({shape("cube")}), "scene.shapes.0.material") == "none");
  CHECK(built(import_of({shape("cube")})).config.scene.objects[0].bsdf->albedo({}) == Rgb(0.5f));
  const Import lamp = import_of({shape("cube", {nested(emitter("area"))})});
  CHECK(part(lamp, "scene.shapes.0.material") == "{ type: diffuse, reflectance: 0 }");
  const auto fog = shape("cube", {nested(object("medium", "homogeneous"), "interior")});
  CHECK(part(import_of({fog}, Dialect::mitsuba_0), "scene.shapes.0.material") ==
        "{ type: pass_through }");
  CHECK(part(import_of({fog}, Dialect::mitsuba_2), "scene.shapes.0.material") == "none");
}

TEST_CASE("shapes: media by scattering and absorption, or by their sum and albedo") {
  const auto with = [](std::vector<Property> properties, Dialect dialect = Dialect::mitsuba_0) {
    const ObjectRef medium = object("medium", "homogeneous", std::move(properties));
    return import_of({shape("cube", {nested(bsdf("diffuse")), nested(medium, "interior")})},
                     dialect);
  };
  const Import import = with({value("sigma_s", rgb(1, 2, 3)), value("scale", 2.0),
                              nested(object("phase", "hg", {value("g", 0.5)}))});
  const std::string name = part(import, "scene.shapes.0.interior");
  CHECK(part(import, ("scene.media." + name).c_str()) ==
        "{ type: homogeneous, phase: { type: henyey_greenstein, g: 0.5 }, scattering: [1, 2, 3], "
        "absorption: [0, 0, 0], scale: 2 }");
  const auto medium_of = [](const Import& i) { return built(i).config.scene.objects[0].interior; };
  CHECK(medium_of(import)->scattering({}) == Rgb(2, 4, 6));
  const auto by_sum = medium_of(with({value("sigma_t", rgb(2, 2, 2)), value("albedo", 0.25)}));
  CHECK(by_sum->scattering({}).g == doctest::Approx(0.5));
  CHECK(by_sum->leg({{}, {0, 0, 1}, 1}, Rgb(1.0f / 3), 1).transmittance.g ==
        doctest::Approx(std::exp(-2.0)));
  CHECK(medium_of(with({}, Dialect::mitsuba_2))->scattering({}) == Rgb(0.75f));
  CHECK_THROWS_AS(with({value("sigma_s", rgb(1, -1, 0))}), InputError);
  CHECK_THROWS_AS(with({nested(object("phase", "hg", {value("g", 1.0)}))}), InputError);
  CHECK_THROWS_AS(with({nested(object("phase", "hh"))}), InputError);
  // One of the named materials of 0.x, which Pharos does not know.
  const Import named = with({value("material", std::string("skim milk"))});
  CHECK(part(named, "scene.shapes.0.interior") == "none");
  CHECK(notes(named)[1] == "medium homogeneous: left out, light passes freely");
}

TEST_CASE("shapes: a textured cube is six squares around the middle, facing outwards") {
  const ObjectRef tiles = bsdf("diffuse", {nested(texture("checkerboard"), "reflectance")});
  for (const bool flip : {false, true}) {
    const LoadedConfig config =
        built(import_of({shape("cube", {nested(tiles), value("flip_normals", flip)})}));
    REQUIRE(config.config.scene.objects.size() == 6);
    Vec3 sum, absolute;
    for (const SceneObject& face : config.config.scene.objects) {
      const SurfacePoint middle = face.shape->sample({0.5f, 0.5f}).point;
      CHECK(dot(middle.normal, Vec3(middle.position)) == doctest::Approx(flip ? -1 : 1));
      sum += middle.position;
      for (int i = 0; i < 3; ++i) absolute[i] += std::abs(middle.position[i]);
    }
    CHECK(length(sum) == doctest::Approx(0));
    CHECK(length(absolute - Vec3{2, 2, 2}) == doctest::Approx(0));
  }
}

TEST_CASE("shapes: groups and instances") {
  const ObjectRef group =
      object("shape", "shapegroup", {nested(shape("cube")), nested(shape("sphere"))}, "Tree");
  const auto at = [&](Vec3 offset) {
    return shape("instance", {nested(group), value("to_world", Transform::translate(offset))});
  };
  const Import import = import_of({group, at({5, 0, 0}), at({-5, 0, 0})});
  CHECK(part(import, "scene.groups") == "{ Tree: [{ type: box }, { type: sphere, radius: 1 }] }");
  CHECK(part(import, "scene.shapes.0") ==
        "{ type: instance, group: Tree, to_world: { matrix: [1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0] } "
        "}");
  CHECK(part(import, "scene.shapes.2") == "none");
  const LoadedConfig config = built(import);
  CHECK(config.config.scene.instances.size() == 2);
  CHECK_THROWS_AS(import_of({shape("instance")}), InputError);
}

TEST_CASE("shapes: merged ones are listed one by one") {
  const Import import =
      import_of({shape("merge", {nested(shape("cube")), nested(shape("rectangle"))})});
  CHECK(part(import, "scene.shapes") == "[{ type: box }, { type: quad }]");
}

}  // namespace pharos::mitsuba::test
