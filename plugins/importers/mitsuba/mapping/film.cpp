#include "film.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace pharos::mitsuba {
namespace {

constexpr std::int64_t kDefaultWidth = 768, kDefaultHeight = 576;
constexpr double kDefaultDeviation = 0.5;
constexpr double kLargestRadius = 16;

ConfigNode map_gaussian(Part& part) {
  ConfigNode node = part.node("gaussian");
  const double deviation = part.number("stddev", kDefaultDeviation);
  node.set("stddev", part.number_or("stddev", kDefaultDeviation), part.where());
  const double radius = std::clamp(4 * deviation, 0.5, kLargestRadius);
  node.set("radius", number_node(radius, part.where()), part.where());
  return node;
}

ConfigNode with_radius(Part& part, const char* type) {
  ConfigNode node = part.node(type);
  if (part.has("radius")) node.set("radius", part.number_or("radius", 1), part.where());
  return node;
}

ConfigNode map_box(Part& part) {
  return with_radius(part, "box");
}
ConfigNode map_tent(Part& part) {
  return with_radius(part, "tent");
}
ConfigNode map_catmull_rom(Part& part) {
  return part.node("catmull_rom");
}

/// Reads `B` or `b` and `C` or `c`: the dialects differ in case.
ConfigNode map_mitchell(Part& part) {
  ConfigNode node = part.node("mitchell");
  node.set("b", part.number_or(part.has("B") ? "B" : "b", 1.0 / 3), part.where());
  node.set("c", part.number_or(part.has("C") ? "C" : "c", 1.0 / 3), part.where());
  return node;
}

ConfigNode map_lanczos(Part& part) {
  ConfigNode node = part.node("lanczos");
  const std::int64_t lobes = part.integer("lobes").value_or(3);
  node.set("lobes", text_node(fmt::format("{}", lobes), part.where()), part.where());
  return node;
}

using Mapper = ConfigNode (*)(Part&);

ConfigNode map_filter(SceneMap& scene, const Object& filter) {
  static const std::map<std::string_view, Mapper> all{
      {"box", map_box},         {"catmullrom", map_catmull_rom}, {"gaussian", map_gaussian},
      {"lanczos", map_lanczos}, {"mitchell", map_mitchell},      {"tent", map_tent}};
  return map_part(scene, filter, UvSense::same, "filter", mapper_of(all, filter));
}

ConfigNode integer_node(std::int64_t value, const Location& where) {
  return text_node(fmt::format("{}", value), where);
}

/// Sets the rendered window, unless it is the whole image.
void set_crop(Part& part, FilmParts& parts, std::int64_t width, std::int64_t height) {
  const std::int64_t x = part.integer("crop_offset_x").value_or(0);
  const std::int64_t y = part.integer("crop_offset_y").value_or(0);
  const std::int64_t w = part.integer("crop_width").value_or(width);
  const std::int64_t h = part.integer("crop_height").value_or(height);
  if (x == 0 && y == 0 && w == width && h == height) return;
  ConfigNode crop = ConfigNode::mapping(part.where());
  const std::pair<const char*, std::int64_t> edges[] = {
      {"x", x}, {"y", y}, {"width", w}, {"height", h}};
  for (const auto& [key, value] : edges) {
    crop.set(key, integer_node(value, part.where()), part.where());
  }
  parts.film.set("crop", std::move(crop), part.where());
}

void set_exposure(Part& part, FilmParts& parts) {
  if (part.text("tonemap_method", "gamma") != "gamma") {
    part.note("film ldrfilm: its tone mapping is left out");
    part.ignore({"exposure", "key", "burn"});
    return;
  }
  if (!part.has("exposure")) return;
  parts.output = ConfigNode::mapping(part.where());
  parts.output.set("exposure", part.number_or("exposure", 0), part.where());
}

/// Ignores the properties of output files, which are not part of a scene in Pharos.
void ignore_files(Part& part) {
  part.ignore({"file_format", "pixel_format", "component_format", "banner", "attach_log",
               "filename", "high_quality_edges", "gamma", "digits", "variable", "compensate",
               "sample_border", "channel_names", "label"});
}

void map_properties(Part& part, FilmParts& parts) {
  const std::int64_t width = part.integer("width").value_or(kDefaultWidth);
  const std::int64_t height = part.integer("height").value_or(kDefaultHeight);
  const auto as_pixels = [](std::int64_t n) {  // the film itself refuses impossible sizes
    return static_cast<int>(std::clamp<std::int64_t>(n, 1, 1 << 20));
  };
  parts.width = as_pixels(width);
  parts.height = as_pixels(height);
  parts.film = ConfigNode::mapping(part.where());
  parts.film.set("width", integer_node(width, part.where()), part.where());
  parts.film.set("height", integer_node(height, part.where()), part.where());
  set_crop(part, parts, width, height);
  if (const Object* filter = part.child("rfilter")) {
    parts.film.set("filter", map_filter(part.map(), *filter), filter->where);
  } else {
    Object standard{.tag = "rfilter", .type = "gaussian", .where = part.where()};
    Part unstated(part.map(), standard);
    parts.film.set("filter", map_gaussian(unstated), part.where());
  }
  ignore_files(part);
  set_exposure(part, parts);
}

}  // namespace

FilmParts map_film(SceneMap& scene, const Object* film, const Location& where) {
  FilmParts parts;
  const Object standard{.tag = "film", .type = "hdrfilm", .where = where};
  const Object& stated = film != nullptr ? *film : standard;
  static const std::map<std::string_view, bool> known{{"hdrfilm", true},
                                                      {"ldrfilm", true},
                                                      {"mfilm", true},
                                                      {"specfilm", true},
                                                      {"tiledhdrfilm", true}};
  mapper_of(known, stated);
  if (stated.type == "specfilm") scene.note(where, "film specfilm: replaced by a film of RGB");
  std::optional<SceneMap::Entry> entry;
  if (film != nullptr) entry.emplace(scene, stated);
  Part part(scene, stated);
  map_properties(part, parts);
  part.finish();
  if (entry) entry->done("film");
  return parts;
}

}  // namespace pharos::mitsuba
