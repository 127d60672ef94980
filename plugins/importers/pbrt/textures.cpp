#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>

#include <fmt/core.h>

#include <pharos/core/color_image.h>

#include "mapping.h"
#include "part.h"

namespace pharos::pbrt {
namespace {

using Average = std::function<std::optional<double>()>;

/// A texture as a node, and its mean.
struct Mapped {
  ConfigNode node;
  Average average = [] { return std::nullopt; };
};

/// Returns an average that is computed at the first request. Copies share it, so that textures
/// made of textures stay small.
Average known_later(Average compute) {
  struct Shared {
    Average compute;
    std::optional<std::optional<double>> value;
  };
  return [shared = std::make_shared<Shared>(Shared{std::move(compute), {}})] {
    if (!shared->value) shared->value = shared->compute();
    return *shared->value;
  };
}

double mean_of(const Color& color) {
  return double{mean(color.value)};
}

/// A color or another texture in a parameter, with its mean.
Mapped read_value(Part& part, const char* name, double otherwise, TextureKind kind,
                  double most = 1e30) {
  Mapped value;
  const Parameter* p = part.find(name);
  if (p == nullptr)
    return {number_node(otherwise, part.where()), [otherwise] { return otherwise; }};
  if (p->type == "texture") {
    value.average = part.scene().texture(*p, kind).average;
  } else {
    const double mean = mean_of(part.scene().color(*p, ColorRole::surface));
    value.average = [mean] { return mean; };
  }
  value.node = part.texture_or(name, otherwise, most, kind);
  return value;
}

/// Places a texture by the mapping `uv`: s = uscale u + udelta. Other mappings are replaced.
ConfigNode placed(Part& part, ConfigNode node, double unit) {
  const std::string mapping = part.text("mapping").value_or("uv");
  if (mapping != "uv") {
    part.note(fmt::format("the mapping '{}' is replaced by the texture coordinates of the shape",
                          one_line(mapping, 60)));
    part.ignore({"v1", "v2", "udelta", "vdelta", "uscale", "vscale"});
    return node;
  }
  const double a = part.number("uscale", 1) * unit, c = part.number("udelta", 0) * unit;
  const double e = part.number("vscale", 1) * unit, f = part.number("vdelta", 0) * unit;
  const auto list = [&](std::initializer_list<double> values) {
    ConfigNode numbers = ConfigNode::sequence(part.where());
    for (const double x : values) numbers.items().push_back(number_node(x, part.where()));
    return numbers;
  };
  if (a == 1 && e == 1 && c == 0 && f == 0) return node;
  if (c == 0 && f == 0) {
    node.set("uv_scale", list({a, e}), part.where());
    return node;
  }
  ConfigNode around = part.node("uv_map");
  around.set("texture", std::move(node), part.where());
  around.set("matrix", list({a, 0, c, 0, e, f}), part.where());
  return around;
}

Mapped map_constant(Part& part, TextureKind kind) {
  Mapped value = read_value(part, "value", 1, kind);
  ConfigNode node = part.node("constant");
  node.set("value", std::move(value.node), part.where());
  return {std::move(node), std::move(value.average)};
}

Average product(const Average& a, const Average& b) {
  return known_later([a, b]() -> std::optional<double> {
    const std::optional<double> x = a(), y = b();
    return x && y ? std::optional(*x * *y) : std::nullopt;
  });
}

Average blend_of(const Average& a, const Average& b, const Average& weight) {
  return known_later([=]() -> std::optional<double> {
    const std::optional<double> x = a(), y = b(), w = weight();
    return x && y && w ? std::optional((1 - *w) * *x + *w * *y) : std::nullopt;
  });
}

Mapped map_scale(Part& part, TextureKind kind) {
  Mapped texture = read_value(part, "tex", 1, kind), factor = read_value(part, "scale", 1, kind);
  ConfigNode node = part.node("scale");
  node.set("texture", std::move(texture.node), part.where());
  node.set("factor", std::move(factor.node), part.where());
  return {std::move(node), product(texture.average, factor.average)};
}

Mapped mixed(Part& part, Mapped first, Mapped second, Mapped weight) {
  ConfigNode node = part.node("mix");
  node.set("first", std::move(first.node), part.where());
  node.set("second", std::move(second.node), part.where());
  node.set("weight", std::move(weight.node), part.where());
  return {std::move(node), blend_of(first.average, second.average, weight.average)};
}

Mapped map_mix(Part& part, TextureKind kind) {
  return mixed(part, read_value(part, "tex1", 0, kind), read_value(part, "tex2", 1, kind),
               read_value(part, "amount", 0.5, TextureKind::number, 1));
}

/// Squares of one unit show the two textures in turn.
Mapped map_checkerboard(Part& part, TextureKind kind) {
  if (part.integer("dimension", 2) != 2) {
    part.note("the cubes of three dimensions are replaced by squares on the surface");
  }
  ConfigNode squares = part.node("checkerboard");
  squares.set("color0", number_node(0, part.where()), part.where());
  squares.set("color1", number_node(1, part.where()), part.where());
  // One unit of Pharos' coordinates contains two by two squares.
  Mapped weight{placed(part, std::move(squares), 0.5), [] { return 0.5; }};
  return mixed(part, read_value(part, "tex1", 1, kind), read_value(part, "tex2", 0, kind),
               std::move(weight));
}

std::optional<double> image_average(const std::filesystem::path& file, bool is_linear) {
  if (!file_problem(file).empty()) return std::nullopt;
  const ColorImage image =
      read_colors(file, is_linear ? pharos::ColorSpace::linear : pharos::ColorSpace::srgb);
  double sum = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) sum += double{mean(image.pixel(x, y))};
  }
  const double average = sum / image.width() / image.height();
  return std::isfinite(average) ? std::optional(average) : std::nullopt;
}

/// Returns whether numbers of 8 and 16 bits are used without conversion.
bool reads_linear(Part& part) {
  const std::string encoding = part.text("encoding").value_or("sRGB");
  if (encoding != "sRGB" && encoding != "linear") {
    part.note(fmt::format("the encoding '{}' is replaced by sRGB", one_line(encoding, 60)));
  }
  return encoding == "linear";
}

std::string read_wrap(Part& part) {
  const std::string wrap = part.text("wrap").value_or("repeat");
  if (wrap == "repeat" || wrap == "clamp") return wrap;
  part.note(fmt::format("wrap '{}' is replaced by 'clamp'", one_line(wrap, 60)));
  return "clamp";
}

/// Scales an image's values, and inverts them then: 1 - scale x.
Mapped adjusted(Part& part, Mapped image) {
  double scale = part.number("scale", 1);
  const bool is_inverted = part.flag("invert", false);
  if (is_inverted && !(scale >= 0 && scale <= 1)) {
    part.note("'scale' is left out, as inverted values must be at least 0");
    scale = 1;
  }
  if (scale != 1) {
    ConfigNode node = part.node("scale");
    node.set("texture", std::move(image.node), part.where());
    node.set("factor", number_node(scale, part.where("scale")), part.where("scale"));
    image = {std::move(node), product(image.average, [scale] { return scale; })};
  }
  if (!is_inverted) return image;
  const auto constant = [&](double value) {
    return Mapped{number_node(value, part.where()), [value] { return value; }};
  };
  return mixed(part, constant(1), constant(0), std::move(image));
}

Mapped map_image(Part& part, TextureKind) {
  ConfigNode node = part.node("bitmap");
  node.set("file", part.file(), part.where());
  const std::string wrap = read_wrap(part);
  if (wrap != "repeat") node.set("wrap", text_node(wrap, part.where()), part.where());
  const bool is_linear = reads_linear(part);
  if (is_linear) node.set("color_space", text_node("linear", part.where()), part.where());
  if (part.text("filter").value_or("bilinear") == "point")
    node.set("filter", text_node("nearest", part.where()), part.where());
  part.ignore({"maxanisotropy"});
  const std::string& name = part.find("filename")->texts.front();
  const std::filesystem::path file = file_in(part.scene().folder(), name);
  return adjusted(part, {placed(part, std::move(node), 1),
                         [file, is_linear] { return image_average(file, is_linear); }});
}

/// The mean of a value at each corner of the unit square.
Mapped map_bilinear(Part& part, TextureKind) {
  Rgb sum;
  for (const char* corner : {"v00", "v01", "v10", "v11"}) {
    const double otherwise = corner[2] == '1' ? 1 : 0;
    const std::optional<Color> stated = part.color(corner, ColorRole::surface);
    sum += stated ? stated->value : Rgb(static_cast<float>(otherwise));
  }
  part.note("replaced by the mean of its corners");
  part.ignore({"mapping", "uscale", "vscale", "udelta", "vdelta"});
  const Color average{.value = 0.25f * sum};
  ConfigNode node = part.node("constant");
  node.set("value", color_node(average, part.where()), part.where());
  const double mean = mean_of(average);
  return {std::move(node), [mean] { return mean; }};
}

/// Stands for textures that Pharos does not have.
Mapped map_other(Part& part, TextureKind) {
  constexpr double kGray = 0.5;
  part.note(fmt::format("replaced by {}", kGray));
  part.ignore_all();
  ConfigNode node = part.node("constant");
  node.set("value", number_node(kGray, part.where()), part.where());
  return {std::move(node), [] { return kGray; }};
}

using Mapper = Mapped (*)(Part&, TextureKind);

}  // namespace

void map_texture(Scene& scene, const Statement& texture) {
  static const std::map<std::string_view, Mapper> all{
      {"bilerp", map_bilinear},   {"checkerboard", map_checkerboard},
      {"constant", map_constant}, {"directionmix", map_other},
      {"dots", map_other},        {"fbm", map_other},
      {"imagemap", map_image},    {"marble", map_other},
      {"mix", map_mix},           {"ptex", map_other},
      {"scale", map_scale},       {"windy", map_other},
      {"wrinkled", map_other}};
  const std::string name = texture.texts[0], type = texture.texts[1];
  if (type != "float" && type != "spectrum") {
    throw InputError(texture.where, fmt::format("a texture is of type 'float' or 'spectrum', "
                                                "found '{}'",
                                                one_line(type, 60)));
  }
  Statement typed = texture;
  typed.texts = {texture.texts[2]};
  const std::size_t object = scene.log().add_object(
      texture.where, fmt::format("texture {} '{}'", typed.type(), one_line(name, 60)));
  Part part(scene, typed, "texture");
  const TextureKind kind = type == "float" ? TextureKind::number : TextureKind::spectrum;
  Mapped mapped = mapper_of(all, typed)(part, kind);
  part.finish();
  scene.log().stands(object, "texture " + mapped.node.find("type")->text());
  scene.add_texture(kind, name, texture.where, std::move(mapped.node), std::move(mapped.average));
}

}  // namespace pharos::pbrt
