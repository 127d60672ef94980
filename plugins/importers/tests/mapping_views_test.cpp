// Sensors, films, samplers and integrators.
#include <cmath>

#include <doctest/doctest.h>

#include <pharos/core/error.h>

#include "mapping_test_kit.h"

namespace pharos::mitsuba::test {
namespace {

ObjectRef film(std::int64_t width, std::int64_t height, std::vector<Property> more = {}) {
  more.push_back(value("width", width));
  more.push_back(value("height", height));
  return object("film", "hdrfilm", std::move(more));
}

Import view(std::vector<Property> properties, std::string type = "perspective") {
  return import_of({object("sensor", std::move(type), std::move(properties))});
}

double fov(std::vector<Property> properties, std::int64_t width, std::int64_t height) {
  properties.push_back(nested(film(width, height)));
  return std::stod(part(view(std::move(properties)), "scene.sensor.fov"));
}

std::string filter(std::string type, std::vector<Property> properties = {}) {
  const ObjectRef kernel = object("rfilter", std::move(type), std::move(properties));
  return part(view({nested(film(64, 64, {nested(kernel)}))}), "film.filter");
}

std::string method(std::string type, std::vector<Property> properties = {}) {
  return part(import_of({object("integrator", std::move(type), std::move(properties))}),
              "integrator");
}

constexpr double kDegree = M_PI / 180;

}  // namespace

TEST_CASE("views: fields of view along every axis") {
  const auto along = [](const char* axis, std::int64_t width, std::int64_t height) {
    return fov({value("fov", 50.0), value("fov_axis", axis)}, width, height);
  };
  const double tangent = std::tan(25 * kDegree);
  const double from_height = 2 * std::atan(2 * tangent) / kDegree;
  CHECK(along("x", 200, 100) == 50);
  CHECK(along("y", 200, 100) == doctest::Approx(from_height));
  CHECK(along("smaller", 200, 100) == doctest::Approx(from_height));
  CHECK(along("larger", 200, 100) == 50);
  CHECK(along("smaller", 100, 200) == 50);
  CHECK(along("larger", 100, 200) == doctest::Approx(2 * std::atan(tangent / 2) / kDegree));
  // The ratio 4 : 3 has a diagonal of 5.
  CHECK(along("diagonal", 400, 300) == doctest::Approx(2 * std::atan(tangent * 4 / 5) / kDegree));
  CHECK(fov({value("fov", 50.0)}, 400, 300) == 50);
  CHECK_THROWS_AS(along("z", 4, 3), InputError);
}

TEST_CASE("views: focal lengths are about the diagonal of 36 x 24 mm") {
  // For the same shape the width is 36 mm.
  const double normal = 2 * std::atan(18.0 / 50) / kDegree;
  CHECK(fov({value("focal_length", "50mm")}, 300, 200) == doctest::Approx(normal));
  CHECK(fov({}, 300, 200) == doctest::Approx(normal));
  CHECK(fov({value("focal_length", "28 mm")}, 300, 200) ==
        doctest::Approx(2 * std::atan(18.0 / 28) / kDegree));
  const double diagonal = std::hypot(36, 24);
  CHECK(fov({value("focal_length", "50")}, 100, 100) ==
        doctest::Approx(2 * std::atan(diagonal / std::sqrt(2.0) / 2 / 50) / kDegree));
  CHECK_THROWS_AS(fov({value("focal_length", "long")}, 100, 100), InputError);
  CHECK_THROWS_AS(fov({value("focal_length", "0mm")}, 100, 100), InputError);
}

TEST_CASE("views: the left of the picture is the camera's +x") {
  const Transform at = Transform::look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0});
  const LoadedConfig config = built(view({value("to_world", at), value("fov", 90.0)}));
  const auto sensor = config.config.scene.sensor->prepare(64, 64);
  const Vec3 left = sensor->ray(sensor->sample_lens({}), {0, 0.5f}).direction;
  CHECK(left.x == doctest::Approx(-std::sqrt(0.5)));
  CHECK(left.z == doctest::Approx(-std::sqrt(0.5)));
  // For a viewer who looks along -z, the world's +x is on the right; a mirror puts it on the left.
  const LoadedConfig mirrored =
      built(view({value("to_world", at * Transform::scale({-1, 1, 1})), value("fov", 90.0)}));
  const auto other = mirrored.config.scene.sensor->prepare(64, 64);
  CHECK(other->ray(other->sample_lens({}), {0, 0.5f}).direction.x ==
        doctest::Approx(std::sqrt(0.5)));
}

TEST_CASE("views: thin lenses and parallel rays") {
  const Import lens =
      view({value("fov", 40.0), value("aperture_radius", 0.15), value("focus_distance", 5.0)},
           "thinlens");
  CHECK(part(lens, "scene.sensor") ==
        "{ type: thin_lens, fov: 40, aperture_radius: 0.15, focus_distance: 5 }");
  CHECK_THROWS_AS(view({value("aperture_radius", 0.15)}, "thinlens"), InputError);
  // The image is two units wide unless scaled.
  const LoadedConfig flat =
      built(view({value("to_world", Transform::scale({3, 3, 1}))}, "orthographic"));
  const auto sensor = flat.config.scene.sensor->prepare(64, 64);
  CHECK(sensor->ray(sensor->sample_lens({}), {0, 0.5f}).origin.x == doctest::Approx(3));
}

TEST_CASE("views: what cameras here cannot is noted") {
  CHECK(notes(view({value("near_clip", 0.01), value("far_clip", 1e4)})).empty());
  CHECK(notes(view({value("near_clip", 2.0)})) ==
        std::vector<std::string>{
            "sensor perspective: nothing is cut off at 'near_clip' and 'far_clip'"});
  CHECK(notes(view({value("principal_point_offset_x", 0.0)})).empty());
  CHECK(notes(view({value("principal_point_offset_x", 0.1)})).size() == 1);
  CHECK(notes(view({value("shutter_open", 0.0), value("shutter_close", 1.0)})).size() == 1);
}

TEST_CASE("views: film and filters") {
  const Import standard = view({});
  CHECK(part(standard, "film.width") == "768");
  CHECK(part(standard, "film.height") == "576");
  CHECK(part(standard, "film.filter") == "{ type: gaussian, stddev: 0.5, radius: 2 }");
  CHECK(filter("gaussian", {value("stddev", 0.25)}) ==
        "{ type: gaussian, stddev: 0.25, radius: 1 }");
  CHECK(filter("box") == "{ type: box }");
  CHECK(filter("tent") == "{ type: tent }");
  CHECK(filter("mitchell", {value("B", 0.5)}).starts_with("{ type: mitchell, b: 0.5, c: 0.33333"));
  CHECK(filter("catmullrom") == "{ type: catmull_rom }");
  CHECK(filter("lanczos", {value("lobes", std::int64_t{2})}) == "{ type: lanczos, lobes: 2 }");
  const Import crop = view({nested(film(
      64, 32, {value("crop_offset_x", std::int64_t{8}), value("crop_width", std::int64_t{16})}))});
  CHECK(part(crop, "film.crop") == "{ x: 8, y: 0, width: 16, height: 32 }");
  CHECK(part(view({nested(film(64, 32))}), "film.crop") == "none");
  const Import bright = view({nested(object("film", "ldrfilm", {value("exposure", 1.5)}))});
  CHECK(part(bright, "output.exposure") == "1.5");
}

TEST_CASE("views: the list of objects has those that the file states") {
  CHECK(view({}).objects.size() == 1);
  const Import import = view({nested(film(8, 8)), nested(object("sampler", "halton"))});
  REQUIRE(import.objects.size() == 3);
  CHECK(import.objects[0].what + " -> " + import.objects[0].stands ==
        "sensor perspective -> sensor perspective");
  CHECK(import.objects[1].what + " -> " + import.objects[1].stands == "film hdrfilm -> film");
  CHECK(import.objects[2].what + " -> " + import.objects[2].stands ==
        "sampler halton -> sampler halton");
}

TEST_CASE("views: samplers and samples") {
  const auto with = [](const char* type) {
    return view({nested(object("sampler", type, {value("sample_count", std::int64_t{64})}))});
  };
  CHECK(part(with("independent"), "sampler") == "independent");
  CHECK(part(with("sobol"), "sampler") == "sobol");
  CHECK(notes(with("sobol")).empty());
  CHECK(part(with("multijitter"), "sampler") == "multi_jittered");
  CHECK(notes(with("multijitter")).empty());
  CHECK(part(with("hammersley"), "sampler") == "halton");
  CHECK(notes(with("hammersley")) ==
        std::vector<std::string>{"sampler hammersley: replaced by halton"});
  CHECK(part(with("halton"), "budget") == "{ spp: 64 }");
  CHECK(part(view({}), "budget") == "{ spp: 4 }");
}

TEST_CASE("views: path depth and roulette") {
  const auto integer = [](const char* name, std::int64_t n) { return value(name, n); };
  CHECK(method("path", {integer("max_depth", 8), integer("rr_depth", 1000)}) ==
        "{ type: path, max_depth: 8 }");
  CHECK(method("path", {integer("max_depth", 8)}) ==
        "{ type: path, max_depth: 8, termination: { type: throughput, depth: 5 } }");
  CHECK(method("path") ==
        "{ type: path, max_depth: 32767, termination: { type: throughput, depth: 5 } }");
  CHECK(method("path", {integer("max_depth", -1), integer("rr_depth", 3)}) ==
        "{ type: path, max_depth: 32767, termination: { type: throughput, depth: 3 } }");
  CHECK(method("direct") == "{ type: path, max_depth: 2 }");
  CHECK(built(import_of({object("integrator", "path")})).config.integrator != nullptr);
}

TEST_CASE("views: a scene without integrator") {
  CHECK(part(import_of({}, Dialect::mitsuba_0), "integrator") == "{ type: path, max_depth: 2 }");
  CHECK(part(import_of({}, Dialect::mitsuba_2), "integrator.max_depth") == "32767");
}

TEST_CASE("views: other integrators are replaced, with a note") {
  const auto noted = [](std::string type, std::vector<Property> more = {}) {
    const std::vector<std::string> all =
        notes(import_of({object("integrator", std::move(type), std::move(more))}));
    return all.front();
  };
  CHECK(noted("bdpt") == "integrator bdpt: replaced by path");
  CHECK(noted("of_my_own") == "integrator of_my_own: replaced by path");
  CHECK(noted("ao") == "integrator ao: replaced by path, which shows light");
  CHECK(noted("path") == "the scene has no sensor");
  CHECK(noted("path", {value("hide_emitters", true)}) ==
        "integrator path: emitters are seen although 'hide_emitters' is set");
  const ObjectRef inner = object("integrator", "path", {value("max_depth", std::int64_t{3})});
  CHECK(method("moment", {nested(inner)}) == "{ type: path, max_depth: 3 }");
}

}  // namespace pharos::mitsuba::test
