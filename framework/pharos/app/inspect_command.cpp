#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <pharos/config/module_loader.h>
#include <pharos/core/error.h>
#include <pharos/core/log.h>
#include <pharos/core/version.h>
#include <pharos/experiments/pictures/density_cloud.h>
#include <pharos/experiments/pictures/density_slice.h>
#include <pharos/experiments/pictures/ellipsoid_picture.h>
#include <pharos/experiments/pictures/scene_outline.h>
#include <pharos/guiding/pipeline/model_file.h>
#include <pharos/rendering/render_config.h>
#include <pharos/rendering/scene_import.h>

#include "commands.h"
#include "inspect_options.h"
#include "threads.h"

namespace pharos {
namespace {

/// A model and the header of its file.
struct InspectedModel {
  ModelHeader header;
  std::shared_ptr<const GuidingModel> model;
};

InspectedModel read_model(const std::filesystem::path& path, const Registry& registry) {
  try {
    const ModelHeader header = read_model_header(path);
    if (registry.find(Learner::contract_name, header.learner) == nullptr) {
      throw InputError(fmt::format(
          "the model file '{}' was learned by '{}', which no module "
          "here has: there are {}",
          path.string(), header.learner, quoted_list(registry.names(Learner::contract_name))));
    }
    BuildContext context{registry};
    ConfigNode resolved;
    const auto learner =
        registry.build<Learner>(ConfigNode::scalar(header.learner), context, resolved);
    return {header, read_model_file(path, *learner)};
  } catch (const InputError& error) {
    throw InputError(fmt::format("pharos inspect: error: {}", error.what()));
  }
}

std::string point_text(Point3 p) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z);
}

void print_facts(const InspectedModel& inspected) {
  const GuidingModel& model = *inspected.model;
  ModelInfo info = model.info();
  const Bounds3 bounds = info.bounds;
  std::vector<ModelFact> facts = {
      {"model", fmt::format("{}, version {}", inspected.header.model, inspected.header.version)},
      {"learner", inspected.header.learner},
      {"saved", fmt::format("{} bytes", inspected.header.bytes)},
      {"memory", fmt::format("{} bytes", info.bytes)},
      {"bounds", bounds.empty()
                     ? "none"
                     : fmt::format("{} to {}", point_text(bounds.low), point_text(bounds.high))},
      {"regions", std::to_string(info.regions)}};
  for (ModelFact& fact : info.facts) facts.push_back(std::move(fact));
  std::size_t width = 0;
  for (const ModelFact& fact : facts) width = std::max(width, fact.name.size());
  for (const ModelFact& fact : facts) fmt::print("{:<{}}  {}\n", fact.name, width, fact.value);
}

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
  Inspection(const InspectOptions& options, const GuidingModel& model, const InspectedScene* scene)
      : options_(options), model_(model), scene_(scene) {}

  Picture picture() const {
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

  Picture slice() const {
    const auto [axis, value] = parse_slice(options_.slice);
    const Bounds3 box = bounds();
    if (!(value >= box.low[axis] && value <= box.high[axis])) {
      throw InputError(Location{fmt::format("--slice {}", options_.slice)},
                       fmt::format("expected a value within the model's bounds, {:.6g} to {:.6g}",
                                   box.low[axis], box.high[axis]));
    }
    const SlicePlane plane = slice_plane(box, axis, value, options_.size);
    Picture picture{
        fmt::format("density at {} = {:.6g}, {}", kAxisNames[axis], value, plane.orientation()),
        density_slice(model_, plane)};
    if (scene_ != nullptr) {
      picture.draw_over = [outline = scene_outline(scene_->scene, plane)](Image& colors) {
        draw_over(colors, outline);
      };
    }
    return picture;
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
  ColorScale scale = density_scale(picture.density);
  if (const auto range = parse_range(options.range)) scale = {range->low, range->high, true};
  write_png(colored(picture, scale), options.output, 0, false);
  log_info(fmt::format("{}: {}, from {:.3g} to {:.3g}{}", options.output.string(), picture.caption,
                       scale.low, scale.high, scale.logarithmic ? ", logarithmic" : ""));
}

void inspect(const InspectOptions& options) {
  check_options(options);
  const Registry registry = load_default_modules();
  const InspectedModel inspected = read_model(options.model, registry);
  if (!options.wants_picture()) return print_facts(inspected);
  const auto scene = read_scene(options.scene, registry);
  const Inspection inspection(options, *inspected.model, scene.get());
  if (!options.ellipsoids.empty()) {
    return write_png(inspection.ellipsoids(), options.output, 0, false);
  }
  write_picture(inspection.picture(), options);
}

}  // namespace

void add_inspect_command(CLI::App& app, int&) {
  CLI::App* command =
      app.add_subcommand("inspect", "Tell of a learned model, or make a picture of it");
  const auto options = std::make_shared<InspectOptions>();
  options->add_to(*command);
  command->callback([options] { with_threads(options->threads, [&] { inspect(*options); }); });
}

}  // namespace pharos
