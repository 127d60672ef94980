#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/core.h>

#include "mapping.h"
#include "part.h"

namespace pharos::pbrt {
namespace {

void set_transform(ConfigNode& node, const Transform& to_world, const Location& where) {
  if (to_world.matrix() == Transform().matrix()) return;
  node.set("to_world", transform_node(to_world, where), where);
}

/// Whether a transform scales evenly and does not shear, as exact spheres and tubes need it.
bool is_even(const Transform& map) {
  const Vec3 x = map.vector({1, 0, 0}), y = map.vector({0, 1, 0}), z = map.vector({0, 0, 1});
  const float size = dot(x, x), slack = 1e-4f * size;
  return std::abs(dot(y, y) - size) < slack && std::abs(dot(z, z) - size) < slack &&
         std::abs(dot(x, y)) < slack && std::abs(dot(y, z)) < slack && std::abs(dot(z, x)) < slack;
}

/// Notes a part of a full turn, which Pharos does not have.
void check_turn(Part& part) {
  if (part.number("phimax", 360) < 360) part.note("goes all the way around, in spite of 'phimax'");
}

/// Returns a surface of revolution about z through points of (radius, z).
ConfigNode lathe(Part& part, const std::vector<std::array<double, 2>>& profile) {
  constexpr int kSegments = 128;
  ConfigNode points = ConfigNode::sequence(part.where());
  for (const auto& [r, z] : profile) {
    ConfigNode point = ConfigNode::sequence(part.where());
    point.items().push_back(number_node(r, part.where()));
    point.items().push_back(number_node(z, part.where()));
    points.items().push_back(std::move(point));
  }
  ConfigNode node = part.node("lathe");
  node.set("profile", std::move(points), part.where());
  node.set("segments", text_node(fmt::format("{}", kSegments), part.where()), part.where());
  part.note("replaced by a mesh, as exact shapes are whole and scaled evenly");
  return node;
}

/// Reads `zmin` and `zmax`, in either order. A sphere ends at its poles.
std::pair<double, double> read_range(Part& part, double lowest, double highest) {
  double low = part.number("zmin", lowest), high = part.number("zmax", highest);
  if (low > high) std::swap(low, high);
  if (part.statement().type() == "sphere") {
    low = std::clamp(low, lowest, highest);
    high = std::clamp(high, lowest, highest);
  }
  if (!(low < high)) throw InputError(part.where("zmin"), "'zmin' must differ from 'zmax'");
  return {low, high};
}

ConfigNode map_sphere(Part& part) {
  check_turn(part);
  const double radius = part.positive("radius", 1);
  const auto [low, high] = read_range(part, -radius, radius);
  const Transform& to_world = part.scene().state().to_world;
  if (low == -radius && high == radius && is_even(to_world)) {
    ConfigNode node = part.node("sphere");
    node.set("radius", number_node(radius, part.where("radius")), part.where("radius"));
    // pbrt's v runs from -z to +z, Pharos' from +z to -z.
    set_transform(node, to_world * Transform::scale({1, 1, -1}), part.where());
    return node;
  }
  constexpr int kSteps = 64;
  const double first = std::acos(low / radius), last = std::acos(high / radius);
  std::vector<std::array<double, 2>> profile;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = first + (last - first) * i / kSteps;
    const double r = radius * std::sin(angle);
    profile.push_back({r < 1e-6 * radius ? 0 : r, radius * std::cos(angle)});
  }
  ConfigNode node = lathe(part, profile);
  set_transform(node, to_world, part.where());
  return node;
}

ConfigNode map_cylinder(Part& part) {
  check_turn(part);
  const double radius = part.positive("radius", 1);
  const auto [low, high] = read_range(part, -1, 1);
  const Transform& to_world = part.scene().state().to_world;
  ConfigNode node;
  if (is_even(to_world)) {
    node = part.node("cylinder");
    node.set("radius", number_node(radius, part.where("radius")), part.where("radius"));
    node.set("p0", triple_node({0, 0, static_cast<float>(low)}, part.where()), part.where());
    node.set("p1", triple_node({0, 0, static_cast<float>(high)}, part.where()), part.where());
  } else {
    node = lathe(part, {{radius, low}, {radius, high}});
  }
  set_transform(node, to_world, part.where());
  return node;
}

ConfigNode map_disk(Part& part) {
  check_turn(part);
  if (part.number("innerradius", 0) > 0) part.note("has no hole, in spite of 'innerradius'");
  const auto radius = static_cast<float>(part.positive("radius", 1));
  const auto height = static_cast<float>(part.number("height", 0));
  ConfigNode node = part.node("disk");
  set_transform(node,
                part.scene().state().to_world * Transform::translate({0, 0, height}) *
                    Transform::scale({radius, radius, 1}),
                part.where());
  return node;
}

/// A mesh whose numbers stand in the scene file, which the reader of meshes reads again.
ConfigNode map_mesh(Part& part) {
  part.ignore({"P", "N", "S", "uv", "indices", "faceIndices"});
  if (!part.has("P")) throw InputError(part.where(), "'P' is missing");
  ConfigNode node = part.node("mesh");
  const std::string file = std::filesystem::path(part.where().file).filename().string();
  node.set("file", text_node(file, part.where()), part.where());
  node.set("part",
           text_node(fmt::format("{}:{}", part.where().line, part.where().column), part.where()),
           part.where());
  set_transform(node, part.scene().state().to_world, part.where());
  return node;
}

ConfigNode map_bilinear_mesh(Part& part) {
  if (part.has("emissionfilename")) part.note("'emissionfilename' is left out");
  part.note("each patch is replaced by two triangles");
  part.ignore({"emissionfilename"});
  return map_mesh(part);
}

ConfigNode map_subdivision(Part& part) {
  part.note("replaced by its control mesh with smooth normals");
  part.ignore({"levels"});
  ConfigNode node = map_mesh(part);
  node.set("normals", text_node("file_or_smooth", part.where()), part.where());
  return node;
}

ConfigNode map_ply(Part& part) {
  ConfigNode node = part.node("mesh");
  node.set("file", part.file(), part.where("filename"));
  if (part.has("displacement")) part.note("'displacement' is left out");
  part.ignore({"displacement", "displacement.edgelength"});
  set_transform(node, part.scene().state().to_world, part.where());
  return node;
}

using Mapper = ConfigNode (*)(Part&);

/// Stands for shapes that Pharos does not have.
ConfigNode leave_out(Part& part) {
  part.note("left out");
  part.ignore_all();
  return {};
}

/// Returns the material of the state, with the holes of the shape's `alpha`.
std::optional<ConfigNode> material_of(Part& part) {
  const std::string& entry = part.scene().state().material;
  ConfigNode material = text_node(entry, part.where());
  if (entry.empty()) {
    material = part.node("two_sided");
    material.set("bsdf", part.node("diffuse"), part.where());
  }
  if (!part.has("alpha")) return material;
  part.note("light samples do not pass the holes of 'alpha', and a hole counts as a segment");
  ConfigNode opacity = part.texture_or("alpha", 1, 1, TextureKind::number);
  ConfigNode around = part.node("mask");
  around.set("bsdf", std::move(material), part.where());
  around.set("opacity", std::move(opacity), part.where("alpha"));
  return around;
}

void set_light(Part& part, ConfigNode& node) {
  const GraphicsState& state = part.scene().state();
  if (state.area_light == nullptr) return;
  if (part.scene().is_in_object()) {
    part.note("does not emit, as in pbrt, because it is part of an object");
    return;
  }
  if (part.scene().is_interface(state.material)) {
    part.note("does not emit, as in pbrt, because its material is 'interface'");
    return;
  }
  node.set("emitter", *state.area_light, state.area_light->where());
}

void set_media(Part& part, ConfigNode& node) {
  const Scene& scene = part.scene();
  const std::string inside = scene.medium(scene.state().inside, part.where());
  const std::string outside = scene.medium(scene.state().outside, part.where());
  if (inside == outside) return;
  if (!inside.empty()) node.set("interior", text_node(inside, part.where()), part.where());
  if (!outside.empty()) node.set("exterior", text_node(outside, part.where()), part.where());
}

}  // namespace

void map_shape(Scene& scene, const Statement& shape) {
  static const std::map<std::string_view, Mapper> all{{"bilinearmesh", map_bilinear_mesh},
                                                      {"curve", leave_out},
                                                      {"cylinder", map_cylinder},
                                                      {"disk", map_disk},
                                                      {"loopsubdiv", map_subdivision},
                                                      {"plymesh", map_ply},
                                                      {"sphere", map_sphere},
                                                      {"trianglemesh", map_mesh}};
  const std::size_t object = scene.log().add_object(shape.where, "shape " + shape.type());
  Part part(scene, shape, "shape");
  ConfigNode node = mapper_of(all, shape)(part);
  if (node.is_null()) return;
  if (scene.state().reverse_orientation) {
    node.set("flip_normals", text_node("true", part.where()), part.where());
  }
  if (std::optional<ConfigNode> material = material_of(part)) {
    node.set("material", std::move(*material), part.where());
  }
  set_light(part, node);
  set_media(part, node);
  part.finish();
  scene.log().stands(object, "shape " + node.find("type")->text());
  scene.add_shape(std::move(node));
}

}  // namespace pharos::pbrt
