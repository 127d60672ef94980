// The placement of textures, compared with Mitsuba's texture coordinates of a shape. In Mitsuba
// images have their first row at v = 0.
#include <cmath>
#include <functional>

#include <doctest/doctest.h>

#include <pharos/core/error.h>
#include <pharos/core/image.h>
#include <pharos/tests/fixtures.h>

#include "mapping_test_kit.h"

namespace pharos::mitsuba::test {
namespace {

using pharos::test::TemporaryFolder;

double fraction(double x) {
  return x - std::floor(x);
}

/// Returns the image of quarters as Mitsuba shows it, repeated: 0.1 and 0.2 in the first row.
double quarters(double u, double v) {
  return 0.1 + (fraction(u) >= 0.5 ? 0.1 : 0) + (fraction(v) >= 0.5 ? 0.2 : 0);
}
double checkers(double u, double v) {
  return (fraction(u) >= 0.5) == (fraction(v) >= 0.5) ? 0.9 : 0.1;
}

Property file_of_quarters(const TemporaryFolder& folder) {
  Image image(2, 2, {"R", "G", "B"});
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 2; ++x) {
      const float shade = 0.1f + 0.1f * static_cast<float>(x) + 0.2f * static_cast<float>(y);
      for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = shade;
    }
  }
  write_exr(image, folder / "quarters.exr");
  return value("filename", (folder / "quarters.exr").string());
}

ObjectRef picture(const TemporaryFolder& folder, std::vector<Property> more = {}) {
  more.push_back(file_of_quarters(folder));
  more.push_back(value("filter_type", "nearest"));
  return texture("bitmap", std::move(more));
}

ObjectRef checkerboard(std::vector<Property> more = {}) {
  more.push_back(value("color0", 0.9));
  more.push_back(value("color1", 0.1));
  return texture("checkerboard", std::move(more));
}

using Shade = std::function<double(double u, double v)>;
using Coordinates = std::function<Vec2(Point3)>;

/// Compares the shade on a textured shape with the shade at Mitsuba's coordinates.
void check_shades(const ObjectRef& pattern, std::string type, std::vector<Property> properties,
                  const Coordinates& coordinates, const Shade& shade) {
  properties.push_back(nested(bsdf("diffuse", {nested(pattern, "reflectance")})));
  const LoadedConfig config = built(import_of({shape(std::move(type), std::move(properties))}));
  int wrong = 0, checked = 0;
  for (const SceneObject& part : config.config.scene.objects) {
    for (int i = 0; i < 400; ++i) {
      const Vec2 u{(static_cast<float>(i % 20) + 0.413f) / 20,
                   (static_cast<float>(i / 20) + 0.587f) / 20};
      const SurfacePoint point = part.shape->sample(u).point;
      const Vec2 uv = coordinates(point.position);
      ++checked;
      wrong += std::abs(part.bsdf->albedo(point).g - shade(uv.x, uv.y)) > 1e-3;
    }
  }
  CHECK(checked >= 400);
  CHECK(wrong == 0);
}

/// Returns Mitsuba's coordinates on the square [-1,1]^2.
Vec2 of_square(Point3 p) {
  return {(p.x + 1) / 2, (p.y + 1) / 2};
}
Vec2 of_square_flipped(Point3 p) {
  return {(p.x + 1) / 2, (1 - p.y) / 2};
}

Vec2 of_sphere(Point3 p) {
  const double azimuth = std::atan2(p.y, p.x) / (2 * M_PI);
  return {static_cast<float>(fraction(azimuth)), static_cast<float>(std::acos(p.z) / M_PI)};
}

constexpr const char* kSquareObj =
    "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "f 1/1 2/2 3/3 4/4\n";
constexpr const char* kSquarePly =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nproperty float u\nproperty float v\nelement face 1\n"
    "property list uchar int vertex_indices\nend_header\n"
    "-1 -1 0 0 0\n1 -1 0 1 0\n1 1 0 1 1\n-1 1 0 0 1\n4 0 1 2 3\n";

/// Returns Mitsuba's coordinates on its cube. The table lists the corners (0, 1), (1, 0) and (0, 0)
/// of each face.
/// 0).
Vec2 of_cube(Point3 p) {
  struct Face {
    Vec3 top_left, bottom_right, origin;
  };
  static constexpr Face faces[] = {
      {{1, -1, -1}, {-1, -1, 1}, {-1, -1, -1}}, {{1, 1, -1}, {-1, 1, 1}, {1, 1, 1}},
      {{1, -1, -1}, {1, 1, 1}, {1, -1, 1}},     {{1, -1, 1}, {-1, 1, 1}, {-1, -1, 1}},
      {{-1, -1, 1}, {-1, 1, -1}, {-1, -1, -1}}, {{1, 1, -1}, {-1, -1, -1}, {-1, 1, -1}}};
  for (const Face& face : faces) {
    const Vec3 u = face.bottom_right - face.origin, v = face.top_left - face.origin;
    if (std::abs(dot(cross(u, v), p - face.origin)) > 1e-4f) continue;
    return {dot(p - face.origin, u) / 4, dot(p - face.origin, v) / 4};
  }
  return {-1, -1};
}

}  // namespace

TEST_CASE("textures: images stand on each shape as Mitsuba shows them") {
  const TemporaryFolder folder;
  const std::string obj = folder.write("square.obj", kSquareObj);
  const std::string ply = folder.write("square.ply", kSquarePly);
  const ObjectRef image = picture(folder);
  check_shades(image, "rectangle", {}, of_square, quarters);
  check_shades(image, "sphere", {}, of_sphere, quarters);
  check_shades(image, "cube", {}, of_cube, quarters);
  check_shades(image, "obj", {value("filename", obj)}, of_square_flipped, quarters);
  check_shades(image, "obj", {value("filename", obj), value("flip_tex_coords", false)}, of_square,
               quarters);
  check_shades(image, "ply", {value("filename", ply)}, of_square, quarters);
  check_shades(image, "ply", {value("filename", ply), value("flip_tex_coords", true)},
               of_square_flipped, quarters);
}

TEST_CASE("textures: patterns too") {
  const TemporaryFolder folder;
  const std::string obj = folder.write("square.obj", kSquareObj);
  check_shades(checkerboard(), "rectangle", {}, of_square, checkers);
  check_shades(checkerboard(), "cube", {}, of_cube, checkers);
  check_shades(checkerboard(), "obj", {value("filename", obj)}, of_square_flipped, checkers);
}

TEST_CASE("textures: stretched and moved") {
  const TemporaryFolder folder;
  const std::string obj = folder.write("square.obj", kSquareObj);
  const std::vector<Property> moves{value("uscale", 2.0), value("vscale", 1.5),
                                    value("uoffset", 0.3), value("voffset", -0.2)};
  const auto moved = [](const Shade& shade) {
    return [shade](double u, double v) { return shade(2 * u + 0.3, 1.5 * v - 0.2); };
  };
  check_shades(picture(folder, moves), "rectangle", {}, of_square, moved(quarters));
  check_shades(picture(folder, moves), "obj", {value("filename", obj)}, of_square_flipped,
               moved(quarters));
  check_shades(checkerboard(moves), "obj", {value("filename", obj)}, of_square_flipped,
               moved(checkers));
}

TEST_CASE("textures: turned by to_uv") {
  const TemporaryFolder folder;
  // (u, v) to (2 v + 0.1, -3 u + 0.2)
  const Transform turned({{{0, 2, 0, 0.1f}, {-3, 0, 0, 0.2f}, {0, 0, 1, 0}}});
  const auto shade = [](double u, double v) { return quarters(2 * v + 0.1, -3 * u + 0.2); };
  check_shades(picture(folder, {value("to_uv", turned)}), "rectangle", {}, of_square, shade);
  check_shades(picture(folder, {value("to_uv", turned)}), "cube", {}, of_cube, shade);
}

TEST_CASE("textures: images that do not repeat") {
  const TemporaryFolder folder;
  const std::vector<Property> clamp{value("wrap_mode", "clamp"), value("uvscale", 3.0)};
  check_shades(picture(folder, clamp), "rectangle", {}, of_square, [](double u, double v) {
    return quarters(std::min(3 * u, 0.99), std::min(3 * v, 0.99));
  });
  const std::vector<Property> mirror{value("wrap_mode", "mirror"), value("uvscale", 2.0)};
  check_shades(picture(folder, mirror), "rectangle", {}, of_square, [](double u, double v) {
    return quarters(u < 0.5 ? 2 * u : 2 - 2 * u, v < 0.5 ? 2 * v : 2 - 2 * v);
  });
}

TEST_CASE("textures: plain scales stay plain") {
  const auto reflectance = [](const ObjectRef& pattern) {
    return part(import_of_bsdf(bsdf("diffuse", {nested(pattern, "reflectance")})),
                "scene.shapes.0.material.reflectance");
  };
  CHECK(reflectance(checkerboard({value("uscale", 8.0), value("vscale", 4.0)})) ==
        "{ type: checkerboard, color0: 0.9, color1: 0.1, uv_scale: [8, 4] }");
  CHECK(reflectance(checkerboard()) == "{ type: checkerboard, color0: 0.9, color1: 0.1 }");
  CHECK(reflectance(texture("bitmap", {value("filename", "a.png"), value("raw", true)})) ==
        "{ type: bitmap, file: a.png, color_space: linear, uv_scale: [1, -1] }");
  CHECK(reflectance(texture("bitmap", {value("filename", "a.png"), value("gamma", 1.0)})) ==
        "{ type: bitmap, file: a.png, color_space: linear, uv_scale: [1, -1] }");
  CHECK(reflectance(texture("scale", {value("scale", 0.5), nested(checkerboard())})) ==
        "{ type: scale, texture: { type: checkerboard, color0: 0.9, color1: 0.1 }, factor: 0.5 }");
  CHECK(reflectance(texture("gridtexture")) ==
        "{ type: grid, color0: 0.2, color1: 0.4, line_width: 0.01 }");
  CHECK_THROWS_AS(reflectance(texture("bitmap", {value("filename", "a"), value("wrap_mode", "x")})),
                  InputError);
}

TEST_CASE("textures: an image as roughness becomes the average of its pixels") {
  const TemporaryFolder folder;
  const auto alpha_of = [](const ObjectRef& image) {
    const Import import = import_of_bsdf(bsdf("roughconductor", {nested(image, "alpha")}));
    return std::stod(part(import, "scene.shapes.0.material.alpha"));
  };
  CHECK(alpha_of(picture(folder)) == doctest::Approx(0.25));
  Image gray(1, 1, {"R", "G", "B"});
  gray.set_rgb(0, 0, Rgb(0.2f));
  write_png(gray, folder / "gray.png", 0, false);
  const Property file = value("filename", (folder / "gray.png").string());
  CHECK(alpha_of(texture("bitmap", {file})) == doctest::Approx(0.2).epsilon(0.02));
  CHECK(alpha_of(texture("bitmap", {file, value("raw", true)})) ==
        doctest::Approx(srgb_from_linear(0.2f)).epsilon(0.01));
  const Property missing = value("filename", (folder / "missing.png").string());
  CHECK(alpha_of(texture("bitmap", {missing})) == doctest::Approx(0.1));
  const std::string text = folder.write("text.png", "text");
  CHECK_THROWS_AS(alpha_of(texture("bitmap", {value("filename", text)})), InputError);
}

TEST_CASE("textures: one that is shared is named, once for each way that v runs") {
  const ObjectRef shared = texture("checkerboard", {}, "Tiles");
  const ObjectRef floor = bsdf("diffuse", {nested(shared, "reflectance")}, "Floor");
  const Import import =
      import_of({shape("rectangle", {nested(floor)}), shape("disk", {nested(floor)}),
                 shape("obj", {value("filename", "a.obj"), nested(floor)})});
  CHECK(part(import, "scene.shapes.0.material") == "Floor");
  CHECK(part(import, "scene.shapes.1.material") == "Floor");
  CHECK(part(import, "scene.shapes.2.material") == "Floor_2");
  CHECK(part(import, "scene.materials.Floor_2") == "{ type: diffuse, reflectance: Tiles_2 }");
  CHECK(part(import, "scene.textures.Tiles") == "{ type: checkerboard, color0: 0.4, color1: 0.2 }");
  CHECK(part(import, "scene.textures.Tiles_2.uv_scale") == "[1, -1]");
}

}  // namespace pharos::mitsuba::test
