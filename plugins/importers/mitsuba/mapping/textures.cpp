// Maps Mitsuba's textures. Its images have their first row at v = 0, the images of Pharos at v = 1.
// Images are therefore flipped if a shape's coordinates are the same in both.
#include "textures.h"

#include <array>
#include <cmath>
#include <numeric>

#include <fmt/core.h>

#include <pharos/core/color_image.h>
#include <pharos/core/error.h>

#include "uv_placement.h"

namespace pharos::mitsuba {
namespace {

/// Returns the color of a texture's property. A texture used as a color is averaged, with a note.
ConfigNode plain_color(Part& part, std::string_view name, double otherwise) {
  const Property* p = part.object().find(name);
  const auto* nested =
      p != nullptr ? std::get_if<std::shared_ptr<const Object>>(&p->value) : nullptr;
  if (nested == nullptr) return part.color_or(name, otherwise);
  part.take(name);
  const std::optional<Rgb> average = texture_average(part.map(), **nested);
  part.note(fmt::format("texture {}: the texture of '{}' is replaced by {}", part.object().type,
                        name, average ? "its average" : "the default"));
  return average ? color_node({.value = *average}, p->where) : number_node(otherwise, p->where);
}

ConfigNode two_colors(Part& part, const char* type, double color0, double color1) {
  ConfigNode node = part.node(type);
  node.set("color0", plain_color(part, "color0", color0), part.where());
  node.set("color1", plain_color(part, "color1", color1), part.where());
  return node;
}

ConfigNode map_checkerboard(Part& part) {
  ConfigNode node = two_colors(part, "checkerboard", 0.4, 0.2);
  return placed(part, std::move(node), read_uv_map(part), UvOrigin::as_here, true);
}

ConfigNode map_grid(Part& part) {
  ConfigNode node = two_colors(part, "grid", 0.2, 0.4);
  node.set("line_width", part.number_or("line_width", 0.01), part.where());
  return placed(part, std::move(node), read_uv_map(part), UvOrigin::as_here, true);
}

/// Returns the wrap mode in Pharos; unsupported modes become `clamp` with a note.
std::string read_wrap(Part& part) {
  std::string mode = part.text("wrap_mode", "repeat");
  const std::string u = part.text("wrap_mode_u", mode.c_str());
  const std::string v = part.text("wrap_mode_v", mode.c_str());
  if (u != v) part.note("texture bitmap: 'wrap_mode_v' is that of u");
  mode = u;
  if (mode == "repeat" || mode == "clamp" || mode == "mirror") return mode;
  if (mode != "zero" && mode != "one") {
    throw InputError(part.where(), fmt::format("unknown wrap mode '{}'; known: 'repeat', 'clamp', "
                                               "'mirror', 'zero', 'one'",
                                               one_line(mode, 60)));
  }
  part.note(fmt::format("texture bitmap: wrap mode '{}' is replaced by 'clamp'", mode));
  return "clamp";
}

/// Returns whether numbers of 8 and 16 bits are used without conversion.
bool reads_linear(Part& part) {
  const bool raw = part.flag("raw", false);
  const std::optional<double> gamma = part.number("gamma");
  if (!gamma || *gamma <= 0) return raw;  // -1 stands for sRGB
  if (*gamma != 1) {
    part.note(fmt::format("texture bitmap: gamma {} is replaced by that of sRGB", *gamma));
  }
  return raw || *gamma == 1;
}

ConfigNode map_bitmap(Part& part) {
  part.ignore({"max_anisotropy", "cache", "format", "accel"});
  ConfigNode node = part.node("bitmap");
  node.set("file", part.file("filename"), part.where());
  if (part.text("filter_type", "bilinear") == "nearest") {
    node.set("filter", text_node("nearest", part.where()), part.where());
  }
  const std::string wrap = read_wrap(part);
  if (wrap != "repeat") node.set("wrap", text_node(wrap, part.where()), part.where());
  if (reads_linear(part)) {
    node.set("color_space", text_node("linear", part.where()), part.where());
  }
  return placed(part, std::move(node), read_uv_map(part), UvOrigin::top_left, wrap == "repeat");
}

ConfigNode map_scale(Part& part) {
  const Object* inner = part.child("texture");
  if (inner == nullptr) {
    throw InputError(part.where(), describe(part.object()) + ": the texture in it is missing");
  }
  ConfigNode node = part.node("scale");
  node.set("texture", map_texture(part.map(), *inner, part.sense(), inner->where), part.where());
  node.set("factor", part.color_or(part.has("scale") ? "scale" : "value", 1), part.where());
  return node;
}

/// Replaces colors at the vertices of a mesh.
ConfigNode map_vertex_colors(Part& part) {
  part.ignore({"name"});
  part.note(fmt::format("texture {}: a mesh's own colors are replaced by 0.5", part.object().type));
  ConfigNode node = part.node("constant");
  node.set("value", number_node(0.5, part.where()), part.where());
  return node;
}

ConfigNode map_uniform(Part& part) {
  ConfigNode node = part.node("constant");
  node.set("value", part.color_or(part.has("color") ? "color" : "value", 0.5), part.where());
  return node;
}

[[noreturn]] ConfigNode refuse(Part& part) {
  throw InputError(part.where(),
                   fmt::format("texture '{}' has no counterpart in Pharos", part.object().type));
}

using Mapper = ConfigNode (*)(Part&);

const std::map<std::string_view, Mapper>& mappers() {
  static const std::map<std::string_view, Mapper> all{{"bitmap", map_bitmap},
                                                      {"checkerboard", map_checkerboard},
                                                      {"gridtexture", map_grid},
                                                      {"scale", map_scale},
                                                      {"srgb", map_uniform},
                                                      {"uniform", map_uniform},
                                                      {"curvature", refuse},
                                                      {"mesh_attribute", map_vertex_colors},
                                                      {"vertexcolors", map_vertex_colors},
                                                      {"wireframe", refuse},
                                                      {"volume", refuse}};
  return all;
}

/// Returns the color of a property that is given as a color.
std::optional<Rgb> stated_color(const Object& object, std::string_view name, float otherwise) {
  const Property* p = object.find(name);
  if (p == nullptr) return Rgb(otherwise);
  if (const auto* s = std::get_if<Spectrum>(&p->value)) return s->value;
  if (const auto* x = std::get_if<double>(&p->value)) return Rgb(static_cast<float>(*x));
  return std::nullopt;
}

/// Returns the average over the pixels of a `bitmap`; see texture_average().
std::optional<Rgb> image_average(Part& part) {
  const ConfigNode node = part.file("filename");
  const std::filesystem::path folder = std::filesystem::path(node.where().file).parent_path();
  const std::filesystem::path file = folder / node.text();
  if (!file_problem(file).empty()) return std::nullopt;
  const ColorImage image =
      read_colors(file, reads_linear(part) ? ColorSpace::linear : ColorSpace::srgb);
  std::array<double, 3> sums{};
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const Rgb color = image.pixel(x, y);
      for (int c = 0; c < 3; ++c) sums[c] += double{color[c]};
    }
  }
  const double pixels = double{1} * image.width() * image.height();
  Rgb average;
  for (int c = 0; c < 3; ++c) average[c] = static_cast<float>(sums[c] / pixels);
  return is_finite(average) ? std::optional(average) : std::nullopt;
}

}  // namespace

ConfigNode map_texture(SceneMap& scene, const Object& texture, UvSense sense,
                       const Location& where) {
  const auto make = [&] {
    return map_part(scene, texture, sense, "texture", mapper_of(mappers(), texture));
  };
  if (texture.id.empty()) return make();
  return text_node(scene.name_in(scene.textures(), texture, sense, make), where);
}

std::optional<Rgb> texture_average(SceneMap& scene, const Object& texture) {
  if (texture.type == "bitmap") {
    Part part(scene, texture);
    return image_average(part);
  }
  const bool is_grid = texture.type == "gridtexture";
  if (!is_grid && texture.type != "checkerboard") return std::nullopt;
  const std::optional<Rgb> color0 = stated_color(texture, "color0", is_grid ? 0.2f : 0.4f);
  const std::optional<Rgb> color1 = stated_color(texture, "color1", is_grid ? 0.4f : 0.2f);
  if (!color0 || !color1) return std::nullopt;
  if (is_grid) return *color0;  // of the ground; lines are thin
  return 0.5f * (*color0 + *color1);
}

}  // namespace pharos::mitsuba
