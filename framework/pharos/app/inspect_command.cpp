#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <pharos/config/module_loader.h>
#include <pharos/core/error.h>
#include <pharos/core/log.h>
#include <pharos/core/threads.h>
#include <pharos/core/version.h>
#include <pharos/experiments/pictures/density_cloud.h>
#include <pharos/experiments/pictures/density_slice.h>
#include <pharos/experiments/pictures/ellipsoid_picture.h>
#include <pharos/experiments/pictures/scene_outline.h>
#include <pharos/rendering/render_config.h>
#include <pharos/rendering/scene_import.h>

#include "commands.h"
#include "inspect_options.h"
#include "model_facts.h"

namespace pharos {
namespace {

/// A scene and the size of its camera's film.
struct InspectedScene {
  Scene scene;
  int film_width, film_height;
};

/// Reads the scene that a config renders. A scene file may be given instead of a config.
std::unique_ptr<const InspectedScene> read_scene(const std::filesystem::path& path,
                                                 const Registry& registry) {
  if (path.empty()) return nullptr;
  ConfigNode node = read_config_or_scene(path, registry);
  if (node.find("scene") == nullptr && node.find("shapes") != nullptr) {
    ConfigNode config = ConfigNode::mapping(node.where());
    config.set("scene", std::move(node));
    config.set("budget", parse_yaml("{ spp: 1 }", "budget"));
    node = std::move(config);
  }
  RenderConfig config = build_render_config(node, registry).config;
  if (config.sensor != nullptr) config.scene.sensor = config.sensor;
  return std::unique_ptr<const InspectedScene>(
      new InspectedScene{Scene(std::move(config.scene)), config.film.width, config.film.height});
}

/// Reads a model file. Throws InputError that names the command.
LearnedFile read_model(const std::filesystem::path& path, const Registry& registry) {
  try {
    return read_learned_file(path, registry);
  } catch (const InputError& error) {
    throw InputError(fmt::format("pharos inspect: error: {}", error.what()));
  }
}

/// A picture of densities, with the images to draw over or behind it.
struct Picture {
  std::string caption;
  Image density;                            ///< one channel, "Y"
  std::function<void(Image&)> draw_over{};  ///< draws over the colors; may be empty
  Image backdrop{};                         ///< visible where the density is low; may be empty
};

/// Makes the picture that the options request.
class Inspection {
 public:
  Inspection(const InspectOptions& options, const LearnedFile& file, const InspectedScene* scene)
      : options_(options), file_(file), model_(*file.models[options.index]), scene_(scene) {}

  Picture picture() const {
    if (options_.shares) return shares();
    if (!options_.slice.empty()) return slice();
    return options_.cloud ? cloud() : directions();
  }

  /// Returns a picture of the Gaussians around a point.
  Image ellipsoids() const {
    if (dynamic_cast<const SpatialMixture*>(&model_) == nullptr) {
      throw InputError(
          fmt::format("pharos inspect: error: the model '{}' has no spatial Gaussians: "
                      "expected --slice, --direction or --cloud",
                      model_.info().name));
    }
    const Point3 point = parse_point("--ellipsoids", options_.ellipsoids);
    Arena arena;
    const CloudView view = view_of(bounds());
    const Point3 from = view.ray(0.5f, 0.5f).origin;
    const auto components = mixture_for_picture(model_, point, from, arena);
    if (components.empty()) {
      throw InputError(fmt::format("--ellipsoids {}: error: the model knows nothing there",
                                   options_.ellipsoids));
    }
    log_info(fmt::format("{}: the {} Gaussians that guide paths at {}", options_.output.string(),
                         components.size(), point_text(point)));
    return ellipsoid_picture(components, view, backdrop(bounds(), view));
  }

 private:
  /// Returns the bounds of the picture: the model's or else the scene's.
  Bounds3 bounds() const {
    const Bounds3 own = model_.info().bounds;
    if (!own.empty()) return own;
    if (scene_ != nullptr) return scene_->scene.bounds();
    throw InputError(
        fmt::format("pharos inspect: error: the model '{}' does not say where it is: expected "
                    "--scene, whose bounds then count",
                    model_.info().name));
  }

  /// Returns the plane of the slice that was asked for. Its longer edge has `size` pixels.
  SlicePlane plane(int size) const {
    const auto [axis, value] = parse_slice(options_.slice);
    const Bounds3 box = bounds();
    if (!(value >= box.low[axis] && value <= box.high[axis])) {
      throw InputError(Location{fmt::format("--slice {}", options_.slice)},
                       fmt::format("expected a value within the model's bounds, {:.6g} to {:.6g}",
                                   box.low[axis], box.high[axis]));
    }
    return slice_plane(box, axis, value, size);
  }

  Picture slice() const {
    const SlicePlane plane = this->plane(options_.size);
    Image density = density_slice(model_, plane);
    const PixelPosition densest = densest_pixel(density);
    const bool is_empty = !(*density.pixel(densest.x, densest.y) > 0);
    std::string caption = fmt::format("density at {} = {:.6g}, {}", kAxisNames[plane.axis],
                                      plane.corner[plane.axis], plane.orientation());
    if (!is_empty) caption += fmt::format("; densest at {}", point_text(center(plane, densest)));
    Picture picture{std::move(caption), std::move(density)};
    picture.draw_over = [this, plane, densest, is_empty](Image& colors) {
      if (scene_ != nullptr) draw_over(colors, scene_outline(scene_->scene, plane));
      if (!is_empty) draw_ring(colors, densest);
    };
    return picture;
  }

  /// Returns the place that the center of a pixel shows.
  static Point3 center(const SlicePlane& plane, PixelPosition pixel) {
    return plane.at((static_cast<float>(pixel.x) + 0.5f) / static_cast<float>(plane.width),
                    (static_cast<float>(pixel.y) + 0.5f) / static_cast<float>(plane.height));
  }

  /// Returns the shares of all techniques on a slice, in panels that fill the picture's width.
  Picture shares() const {
    const int columns = static_cast<int>(file_.mixing.methods.size()) + 1;
    const SlicePlane plane = this->plane(std::max(16, options_.size / columns - kPanelGap));
    std::string techniques = "unguided";
    for (const LearnedMethod& method : file_.head.methods) {
      techniques += ", " + file_.head.models[method.model].learner;
    }
    std::vector<ShownVertex> vertices;
    for (const float roughness : kShownRoughness) vertices.push_back({roughness, options_.bounce});
    Picture picture{
        fmt::format("shares at {} = {:.6g}, {}; from left to right: {}; from top to bottom: "
                    "roughness {:g}",
                    kAxisNames[plane.axis], plane.corner[plane.axis], plane.orientation(),
                    techniques, fmt::join(kShownRoughness, ", ")),
        share_slices(file_.mixing, plane, vertices)};
    picture.draw_over = [this, plane](Image& colors) { decorate_panels(colors, plane); };
    return picture;
  }

  /// Makes the gaps between panels white, and draws the scene's outline over each panel.
  void decorate_panels(Image& colors, const SlicePlane& plane) const {
    const Image outline = scene_ == nullptr ? Image() : scene_outline(scene_->scene, plane);
    Image coverage(colors.width(), colors.height(), {"Y"});
    for (int y = 0; y < colors.height(); ++y) {
      for (int x = 0; x < colors.width(); ++x) {
        const int u = x % (plane.width + kPanelGap), v = y % (plane.height + kPanelGap);
        const bool is_gap = u >= plane.width || v >= plane.height;
        *coverage.pixel(x, y) = is_gap ? 1 : outline.empty() ? 0 : *outline.pixel(u, v);
      }
    }
    draw_over(colors, coverage);
  }

  Picture directions() const {
    const Point3 point = parse_point("--direction", options_.direction);
    return {fmt::format("density over directions at {}, y up, +z in the middle", point_text(point)),
            density_directions(model_, point, options_.size / 2)};
  }

  Picture cloud() const {
    const Bounds3 box = bounds();
    const CloudView view = view_of(box);
    return {"largest density along each line of sight",
            cloud_density(model_, box, view),
            {},
            backdrop(box, view)};
  }

  /// Returns the view of the scene's camera, or a view of the whole box if there is no scene.
  CloudView view_of(const Bounds3& box) const {
    if (scene_ == nullptr) return oblique_view(box, options_.size);
    return camera_view(scene_->scene, scene_->film_width, scene_->film_height, options_.size);
  }
  Image backdrop(const Bounds3& box, const CloudView& view) const {
    return scene_ == nullptr ? box_edges(box, options_.size) : shaded_scene(scene_->scene, view);
  }

  const InspectOptions& options_;
  const LearnedFile& file_;
  const GuidingModel& model_;
  const InspectedScene* scene_;
};

Image colored(const Picture& picture, const ColorScale& scale) {
  if (!picture.backdrop.empty()) return cloud_picture(picture.density, scale, picture.backdrop);
  Image colors = false_color(picture.density, scale);
  if (picture.draw_over) picture.draw_over(colors);
  return colors;
}

void write_picture(const Picture& picture, const InspectOptions& options) {
  if (options.wants_exr()) {
    write_exr(picture.density, options.output,
              {{"pharos:version", version()}, {"pharos:caption", picture.caption}});
    log_info(fmt::format("{}: {}", options.output.string(), picture.caption));
    return;
  }
  ColorScale scale = options.shares ? ColorScale{0, 1} : density_scale(picture.density);
  if (const auto range = parse_range(options.range)) scale = {range->low, range->high, true};
  write_png(colored(picture, scale), options.output, 0, false);
  log_info(fmt::format("{}: {}; colors from {:.3g} to {:.3g}{}", options.output.string(),
                       picture.caption, scale.low, scale.high,
                       scale.logarithmic ? ", logarithmic" : ""));
}

void inspect(const InspectOptions& options) {
  check_options(options);
  const Registry registry = load_default_modules();
  const LearnedFile file = read_model(options.model, registry);
  const auto scene = read_scene(options.scene, registry);
  if (!options.wants_picture()) {
    return print_facts(file, scene == nullptr ? Bounds3() : scene->scene.bounds());
  }
  if (options.index >= file.models.size()) {
    throw InputError(fmt::format("--index {}: error: the file has {} models, counted from 0",
                                 options.index, file.models.size()));
  }
  const Inspection inspection(options, file, scene.get());
  if (!options.ellipsoids.empty()) {
    return write_png(inspection.ellipsoids(), options.output, 0, false);
  }
  write_picture(inspection.picture(), options);
}

}  // namespace

void add_inspect_command(CLI::App& app, int&) {
  CLI::App* command =
      app.add_subcommand("inspect", "Tell of learned models, or make a picture of one");
  const auto options = std::make_shared<InspectOptions>();
  options->add_to(*command);
  command->callback([options] { with_threads(options->threads, [&] { inspect(*options); }); });
}

}  // namespace pharos
