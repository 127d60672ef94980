// pbrt's cameras look along +z with +x on the right of the image, cameras of Pharos with +x on the
// left. Apart from that, both programs use the same formulas for the coordinates that a file gives,
// whether its author thinks of them as left-handed or right-handed.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/core.h>

#include "mapping.h"
#include "part.h"

namespace pharos::pbrt {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

struct Size {
  int width = 1280, height = 720;
  double aspect() const { return static_cast<double>(width) / height; }
};

ConfigNode integer_node(int value, const Location& where) {
  return text_node(fmt::format("{}", value), where);
}

// Film

void set_crop(ConfigNode& film, const std::array<int, 4>& edges, const Location& where) {
  const auto [x0, x1] = std::minmax(edges[0], edges[1]);
  const auto [y0, y1] = std::minmax(edges[2], edges[3]);
  ConfigNode crop = ConfigNode::mapping(where);
  crop.set("x", integer_node(x0, where), where);
  crop.set("y", integer_node(y0, where), where);
  crop.set("width", integer_node(x1 - x0, where), where);
  crop.set("height", integer_node(y1 - y0, where), where);
  film.set("crop", std::move(crop), where);
}

/// Reads the window of pixels, as fractions or as pixels.
void read_window(Part& part, ConfigNode& film, Size size) {
  const std::vector<double> fractions = part.numbers("cropwindow", 4);
  const std::vector<double> pixels = part.numbers("pixelbounds", 4);
  if (!fractions.empty()) {
    const auto edge = [](double share, int n) {
      return static_cast<int>(std::ceil(std::clamp(share, 0.0, 1.0) * n));
    };
    set_crop(film,
             {edge(fractions[0], size.width), edge(fractions[1], size.width),
              edge(fractions[2], size.height), edge(fractions[3], size.height)},
             part.where("cropwindow"));
  } else if (!pixels.empty()) {
    const auto edge = [](double at, int n) {
      return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(n)));
    };
    set_crop(film,
             {edge(pixels[0], size.width), edge(pixels[1], size.width),
              edge(pixels[2], size.height), edge(pixels[3], size.height)},
             part.where("pixelbounds"));
  }
}

/// Notes a brightness or a sensor that Pharos does not have. `exposure` is in seconds; with one
/// second and ISO 100 the image shows radiance.
void check_sensor(Part& part, double exposure) {
  const double brightness = exposure * part.number("iso", 100) / 100;
  if (std::abs(brightness - 1) > 1e-6) {
    part.note(fmt::format("pbrt's image is {:.4g} times as bright", brightness));
  }
  const std::string sensor = part.text("sensor").value_or("cie1931");
  if (sensor != "cie1931") part.note(fmt::format("the sensor '{}' is left out", sensor));
  if (part.number("whitebalance", 0) != 0) part.note("'whitebalance' is left out");
  if (part.has("maxcomponentvalue")) part.note("'maxcomponentvalue' does not limit the values");
  part.ignore({"diagonal", "filename", "savefp16", "maxcomponentvalue", "coordinatesystem",
               "lambdamin", "lambdamax", "nbuckets"});
}

Size map_film(Scene& scene, const Statement& film, double exposure) {
  static const std::map<std::string_view, bool> known{
      {"gbuffer", true}, {"rgb", true}, {"spectral", false}};
  const std::size_t object = scene.log().add_object(film.where, "Film " + film.type());
  Part part(scene, film);
  if (!mapper_of(known, film)) part.note("replaced by a film of RGB");
  Size size;
  size.width = std::max(1, part.integer("xresolution", size.width));
  size.height = std::max(1, part.integer("yresolution", size.height));
  scene.film = ConfigNode::mapping(film.where);
  scene.film.set("width", integer_node(size.width, film.where), film.where);
  scene.film.set("height", integer_node(size.height, film.where), film.where);
  read_window(part, scene.film, size);
  check_sensor(part, exposure);
  part.finish();
  scene.log().stands(object, "film");
  return size;
}

// Pixel filter

/// Returns the radius, which pbrt gives for x and y.
double filter_radius(Part& part, double otherwise) {
  const double x = part.positive("xradius", otherwise), y = part.positive("yradius", otherwise);
  if (x != y) part.note("the radius in y is that in x");
  return x;
}

ConfigNode with_radius(Part& part, const char* type, double otherwise) {
  ConfigNode node = part.node(type);
  node.set("radius", number_node(filter_radius(part, otherwise), part.where()), part.where());
  return node;
}

ConfigNode map_box(Part& part) {
  return with_radius(part, "box", 0.5);
}

ConfigNode map_triangle(Part& part) {
  return with_radius(part, "tent", 2);
}

ConfigNode map_gaussian(Part& part) {
  ConfigNode node = with_radius(part, "gaussian", 1.5);
  node.set("stddev", number_node(part.positive("sigma", 0.5), part.where()), part.where());
  return node;
}

ConfigNode map_mitchell(Part& part) {
  ConfigNode node = with_radius(part, "mitchell", 2);
  node.set("b", number_node(part.number("B", 1.0 / 3), part.where()), part.where());
  node.set("c", number_node(part.number("C", 1.0 / 3), part.where()), part.where());
  return node;
}

/// The radius of pbrt's window is the number of lobes of a Lanczos filter if it equals `tau`.
ConfigNode map_sinc(Part& part) {
  const double radius = filter_radius(part, 4), tau = part.number("tau", 3);
  const int lobes = std::clamp(static_cast<int>(std::lround(std::min(radius, tau))), 1, 16);
  if (radius != tau || lobes != radius) part.note(fmt::format("has {} lobes", lobes));
  ConfigNode node = part.node("lanczos");
  node.set("lobes", integer_node(lobes, part.where()), part.where());
  return node;
}

using Mapper = ConfigNode (*)(Part&);

ConfigNode map_filter(Scene& scene, const Statement& filter) {
  static const std::map<std::string_view, Mapper> all{{"box", map_box},
                                                      {"gaussian", map_gaussian},
                                                      {"mitchell", map_mitchell},
                                                      {"sinc", map_sinc},
                                                      {"triangle", map_triangle}};
  Part part(scene, filter);
  ConfigNode node = mapper_of(all, filter)(part);
  part.finish();
  return node;
}

// Camera

/// Half the extent of the image in x, where the field of view spans from -1 to 1.
double half_width(Part& part, Size size) {
  const double aspect = part.positive("frameaspectratio", size.aspect());
  if (std::abs(aspect - size.aspect()) > 1e-3 * aspect) {
    part.note("'frameaspectratio' differs from the shape of the film, and pixels are square");
  }
  const std::vector<double> window = part.numbers("screenwindow", 4);
  if (window.empty()) return std::max(aspect, 1.0);
  const double half = (window[1] - window[0]) / 2;
  const double middle = std::abs(window[0] + window[1]) + std::abs(window[2] + window[3]);
  if (!(half > 0)) {
    throw InputError(part.where("screenwindow"), "'screenwindow' must extend to the right");
  }
  const bool is_square = std::abs(half / size.aspect() - (window[3] - window[2]) / 2) < 1e-3 * half;
  if (middle > 1e-6 || !is_square) part.note("only the width of 'screenwindow' is used");
  return half;
}

/// Returns the field of view across the width [degrees].
double field_of_view(Part& part, Size size) {
  double fov = part.positive("fov", 90);
  if (const std::optional<double> half = part.number("halffov")) fov = 2 * *half;
  if (!(fov > 0 && fov < 180)) {
    throw InputError(part.where(part.has("fov") ? "fov" : "halffov"),
                     "the field of view must be above 0 and below 180 degrees");
  }
  return 2 * std::atan(half_width(part, size) * std::tan(fov / 2 * kDegree)) / kDegree;
}

ConfigNode map_perspective(Part& part, Size size) {
  const double radius = part.number("lensradius", 0);
  const double focus = part.positive("focaldistance", 1e6);
  ConfigNode node = part.node(radius > 0 ? "thin_lens" : "perspective");
  node.set("fov", number_node(field_of_view(part, size), part.where()), part.where());
  if (radius > 0) {
    node.set("aperture_radius", number_node(radius, part.where()), part.where());
    node.set("focus_distance", number_node(focus, part.where()), part.where());
  }
  return node;
}

ConfigNode map_orthographic(Part& part, Size size) {
  if (part.number("lensradius", 0) > 0) part.note("the lens is left out, everything is sharp");
  part.ignore({"focaldistance"});
  ConfigNode node = part.node("orthographic");
  node.set("width", number_node(2 * half_width(part, size), part.where()), part.where());
  return node;
}

/// Stands for cameras that Pharos does not have.
ConfigNode map_other_camera(Part& part, Size size) {
  constexpr double kFieldOfView = 50;
  part.note(fmt::format("replaced by a perspective camera with {} degrees across the shorter edge",
                        kFieldOfView));
  part.ignore_all();
  ConfigNode node = part.node("perspective");
  const double half = std::max(size.aspect(), 1.0) * std::tan(kFieldOfView / 2 * kDegree);
  node.set("fov", number_node(2 * std::atan(half) / kDegree, part.where()), part.where());
  return node;
}

using CameraMapper = ConfigNode (*)(Part&, Size);

void map_camera(Scene& scene, const View& view, Size size) {
  static const std::map<std::string_view, CameraMapper> all{{"orthographic", map_orthographic},
                                                            {"perspective", map_perspective},
                                                            {"realistic", map_other_camera},
                                                            {"spherical", map_other_camera}};
  const Statement& camera = *view.camera;
  const std::size_t object = scene.log().add_object(camera.where, "Camera " + camera.type());
  Part part(scene, camera);
  scene.sensor = mapper_of(all, camera)(part, size);
  scene.sensor.set(
      "to_world", transform_node(view.camera_to_world * Transform::scale({-1, 1, 1}), camera.where),
      camera.where);
  part.ignore({"shutteropen", "shutterclose"});
  part.finish();
  scene.log().stands(object, "sensor " + scene.sensor.find("type")->text());
  const std::string medium = scene.medium(view.camera_medium, camera.where);
  if (!medium.empty()) scene.medium_of_camera = text_node(medium, camera.where);
}

// Sampler

struct NearestSampler {
  const char* name;
  bool is_same;
};

void map_sampler(Scene& scene, const Statement& sampler) {
  static const std::map<std::string_view, NearestSampler> all{
      {"halton", {"halton", true}},     {"independent", {"independent", true}},
      {"paddedsobol", {"sobol", true}}, {"pmj02bn", {"pmj02bn", true}},
      {"sobol", {"sobol", false}},      {"stratified", {"stratified", true}},
      {"zsobol", {"z_sobol", true}}};
  Part part(scene, sampler);
  const NearestSampler nearest = mapper_of(all, sampler);
  if (!nearest.is_same) part.note(fmt::format("replaced by {}", nearest.name));
  const bool is_grid = sampler.type() == "stratified";
  const int otherwise = sampler.type() == "independent" ? 4 : 16;
  const double samples = is_grid
                             ? double{1} * part.integer("xsamples", 4) * part.integer("ysamples", 4)
                             : part.integer("pixelsamples", otherwise);
  part.ignore({"seed", "randomization", "jitter"});
  part.finish();
  scene.sampler = text_node(nearest.name, sampler.where);
  scene.budget = ConfigNode::mapping(sampler.where);
  scene.budget.set("spp",
                   integer_node(static_cast<int>(std::clamp(samples, 1.0, 1e9)), sampler.where),
                   sampler.where);
}

// Integrator

/// One less than the longest path of all integrators.
constexpr int kMostBounces = 32766;

/// Whether an integrator is a path tracer, as Pharos' is, or shows the same image, or another one.
enum class Method { path, same_image, other_image };

void map_integrator(Scene& scene, const Statement& integrator) {
  static const std::map<std::string_view, Method> all{{"ambientocclusion", Method::other_image},
                                                      {"bdpt", Method::same_image},
                                                      {"function", Method::other_image},
                                                      {"lightpath", Method::same_image},
                                                      {"mlt", Method::same_image},
                                                      {"path", Method::path},
                                                      {"randomwalk", Method::same_image},
                                                      {"simplepath", Method::path},
                                                      {"simplevolpath", Method::path},
                                                      {"sppm", Method::same_image},
                                                      {"volpath", Method::path}};
  Part part(scene, integrator);
  const Method method = mapper_of(all, integrator);
  if (method == Method::same_image) part.note("replaced by path");
  if (method == Method::other_image) part.note("replaced by path, which shows light");
  if (part.flag("regularize", false)) part.note("'regularize' is left out");
  // pbrt counts bounces, Pharos the segments between the lens and the light.
  const int bounces = std::clamp(part.integer("maxdepth", 5), 0, kMostBounces);
  scene.integrator = part.node("path");
  scene.integrator.set("max_depth", integer_node(bounces + 1, part.where("maxdepth")),
                       part.where("maxdepth"));
  scene.integrator.set("termination", text_node("throughput", part.where()), part.where());
  part.ignore({"lightsampler", "samplelights", "samplebsdf"});
  if (method == Method::path) return part.finish();
  part.ignore_all();
}

/// Returns the stated directive, or one of `type` without parameters.
Statement stated_or(const std::optional<Statement>& stated, const char* word, const char* type,
                    const Location& where) {
  return stated ? *stated : Statement{word, where, {type}, {}, {}};
}

}  // namespace

void map_view(Scene& scene, const View& view) {
  const Location where = view.camera ? view.camera->where : Location{};
  const Statement camera = stated_or(view.camera, "Camera", "perspective", where);
  Part shutter(scene, camera);
  const double exposure = shutter.number("shutterclose", 1) - shutter.number("shutteropen", 0);
  const Size size = map_film(scene, stated_or(view.film, "Film", "rgb", where), exposure);
  scene.film.set(
      "filter", map_filter(scene, stated_or(view.filter, "PixelFilter", "gaussian", where)), where);
  if (view.camera) {
    map_camera(scene, view, size);
  } else {
    scene.note(where, "the scene has no Camera");
  }
  map_sampler(scene, stated_or(view.sampler, "Sampler", "zsobol", where));
  map_integrator(scene, stated_or(view.integrator, "Integrator", "volpath", where));
}

}  // namespace pharos::pbrt
