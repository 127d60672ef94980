#include "sensors.h"

#include <cmath>
#include <numbers>

#include <fmt/core.h>

#include <pharos/config/values.h>

#include "media.h"

namespace pharos::mitsuba {
namespace {

/// The diagonal of 36 x 24 mm film for still cameras, to which focal lengths refer.
const double kFilmDiagonal = std::hypot(36.0, 24.0);
constexpr double kDefaultFocalLength = 50;
constexpr double kDegree = std::numbers::pi / 180;
/// Clipping planes beyond these limits are unlikely to cut anything.
constexpr double kNearEnough = 0.1, kFarEnough = 1000;

/// Returns twice the tangent of half an angle [degrees], which is the visible width at distance 1.
double extent(double degrees) {
  return 2 * std::tan(degrees * kDegree / 2);
}
double angle(double extent) {
  return 2 * std::atan(extent / 2) / kDegree;
}

/// Returns the angle across the width [degrees] for `fov` along an axis of a film with this aspect
/// ratio.
double across_width(double fov, const std::string& axis, double aspect) {
  if (axis == "x") return fov;
  if (axis == "y") return angle(extent(fov) * aspect);
  return angle(extent(fov) * aspect / std::hypot(aspect, 1.0));
}

/// Reads "50mm" or "50".
double focal_length(Part& part) {
  const Property* p = part.object().find("focal_length");
  if (p == nullptr) return kDefaultFocalLength;
  if (!std::holds_alternative<std::string>(p->value)) return part.number("focal_length", 0);
  std::string text = *part.text("focal_length");
  if (text.size() > 2 && text.ends_with("mm")) text.resize(text.size() - 2);
  while (!text.empty() && text.back() == ' ') text.pop_back();
  if (!is_number(text)) throw InputError(p->where, "'focal_length' must be such as 50mm");
  return read_number(ConfigNode::scalar(text, p->where));
}

std::string read_axis(Part& part, double aspect) {
  const std::string axis = part.text("fov_axis", "x");
  if (axis == "smaller") return aspect > 1 ? "y" : "x";
  if (axis == "larger") return aspect > 1 ? "x" : "y";
  static const std::vector<std::string> known{"x", "y", "diagonal", "smaller", "larger"};
  if (axis == "x" || axis == "y" || axis == "diagonal") return axis;
  throw InputError(part.object().find("fov_axis")->where,
                   fmt::format("unknown 'fov_axis' '{}'{}; known: {}", one_line(axis, 60),
                               suggestion(axis, known), quoted_list(known)));
}

void set_fov(Part& part, ConfigNode& node, const FilmParts& film) {
  const double aspect = static_cast<double>(film.width) / film.height;
  const Property* stated = part.object().find("fov");
  if (stated != nullptr) {
    const double fov = part.number("fov", 0);
    const std::string axis = read_axis(part, aspect);
    node.set("fov", number_node(across_width(fov, axis, aspect), stated->where), stated->where);
    part.ignore({"focal_length"});
    return;
  }
  const double length = focal_length(part);
  if (!(length > 0)) throw InputError(part.where(), "'focal_length' must be above 0");
  part.ignore({"fov_axis"});  // focal lengths refer to the diagonal
  const double fov = across_width(angle(kFilmDiagonal / length), "diagonal", aspect);
  node.set("fov", number_node(fov, part.where()), part.where());
}

/// Notes the properties of sensors that Pharos does not have.
void note_the_rest(Part& part) {
  const bool cuts =
      part.number("near_clip", 0) > kNearEnough || part.number("far_clip", kFarEnough) < kFarEnough;
  if (cuts) {
    part.note(fmt::format("sensor {}: nothing is cut off at 'near_clip' and 'far_clip'",
                          part.object().type));
  }
  part.expect("principal_point_offset_x", 0);
  part.expect("principal_point_offset_y", 0);
  if (part.number("shutter_open", 0) !=
      part.number("shutter_close", part.number("shutter_open", 0))) {
    part.note(
        fmt::format("sensor {}: nothing moves while the shutter is open", part.object().type));
  }
}

ConfigNode map_perspective(Part& part, const FilmParts& film) {
  ConfigNode node = part.node("perspective");
  set_fov(part, node, film);
  part.copy_transform(node, "to_world");
  part.ignore({"focus_distance", "aperture_radius"});
  return node;
}

ConfigNode map_thin_lens(Part& part, const FilmParts& film) {
  ConfigNode node = part.node("thin_lens");
  set_fov(part, node, film);
  part.copy_transform(node, "to_world");
  for (const char* key : {"aperture_radius", "focus_distance"}) {
    if (!part.has(key)) {
      throw InputError(part.where(), fmt::format("sensor thinlens: '{}' is missing", key));
    }
    node.set(key, part.number_or(key, 0), part.where());
  }
  return node;
}

/// The image is two units wide before `to_world` scales it.
ConfigNode map_orthographic(Part& part, const FilmParts&) {
  ConfigNode node = part.node("orthographic");
  part.copy_transform(node, "to_world");
  return node;
}

[[noreturn]] ConfigNode refuse(Part& part, const FilmParts&) {
  throw InputError(part.where(),
                   fmt::format("sensor '{}' has no counterpart in Pharos", part.object().type));
}

using Mapper = ConfigNode (*)(Part&, const FilmParts&);

const std::map<std::string_view, Mapper>& mappers() {
  static const std::map<std::string_view, Mapper> all{{"batch", refuse},
                                                      {"distant", refuse},
                                                      {"fluencemeter", refuse},
                                                      {"irradiancemeter", refuse},
                                                      {"orthographic", map_orthographic},
                                                      {"perspective", map_perspective},
                                                      {"perspective_rdist", refuse},
                                                      {"radiancemeter", refuse},
                                                      {"spherical", refuse},
                                                      {"telecentric", refuse},
                                                      {"thinlens", map_thin_lens}};
  return all;
}

/// The equivalent of another renderer's sampler, or the nearest one.
struct NearestSampler {
  const char* name;
  bool is_same;
};

const char* sampler_here(SceneMap& scene, const Object& sampler) {
  static const std::map<std::string_view, NearestSampler> all{
      {"independent", {"independent", true}},
      {"stratified", {"stratified", true}},
      {"multijitter", {"multi_jittered", true}},
      {"halton", {"halton", true}},
      {"sobol", {"sobol", true}},
      {"ldsampler", {"sobol", false}},
      {"hammersley", {"halton", false}},
      {"orthogonal", {"multi_jittered", false}}};
  const NearestSampler& nearest = mapper_of(all, sampler);
  if (!nearest.is_same) {
    scene.note(sampler.where,
               fmt::format("sampler {}: replaced by {}", sampler.type, nearest.name));
  }
  return nearest.name;
}

void map_sampler(SceneMap& scene, const Object* sampler, Camera& camera, const Location& where) {
  const Object standard{.tag = "sampler", .type = "independent", .where = where};
  const Object& stated = sampler != nullptr ? *sampler : standard;
  const char* name = sampler_here(scene, stated);
  std::optional<SceneMap::Entry> entry;
  if (sampler != nullptr) entry.emplace(scene, stated);
  Part part(scene, stated);
  part.ignore({"seed", "dimension", "scramble", "jitter", "strength", "wavefront_size"});
  const std::int64_t samples = part.integer("sample_count").value_or(4);
  part.finish();
  if (entry) entry->done(std::string("sampler ") + name);
  camera.sampler = text_node(name, stated.where);
  camera.budget = ConfigNode::mapping(stated.where);
  camera.budget.set("spp", text_node(fmt::format("{}", samples), stated.where), stated.where);
}

}  // namespace

Camera map_sensor(SceneMap& scene, const Object& sensor) {
  const Mapper& mapper = mapper_of(mappers(), sensor);
  Camera camera;
  camera.sensor = map_part(scene, sensor, UvSense::same, "sensor", [&](Part& part) {
    camera.film = map_film(scene, part.child("film"), part.where());
    map_sampler(scene, part.child("sampler"), camera, part.where());
    if (const Object* medium = part.child("medium")) {
      if (std::optional<ConfigNode> name = map_medium(scene, *medium)) camera.medium = *name;
    }
    ConfigNode node = mapper(part, camera.film);
    note_the_rest(part);
    return node;
  });
  return camera;
}

}  // namespace pharos::mitsuba
