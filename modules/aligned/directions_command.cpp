// directions: draws the directions that the sampler `aligned` estimates in a scene. There is one
// picture for each dimension that the sampler aligns. It shows the render, and in each block the
// principal directions of the edges in the plane of the two numbers (figure 7 of the paper). The
// command uses the sampler of the render config. If the config has another sampler, the command
// uses `aligned` with default settings.
//
//     pharos directions --render configs/cornell-box.yaml -o directions.png
#include "directions_command.h"

#include <memory>
#include <vector>

#include <fmt/format.h>

#include <pharos/config/module_loader.h>
#include <pharos/core/error.h>
#include <pharos/core/writable.h>
#include <pharos/experiments/pictures/point_pictures.h>
#include <pharos/rendering/render_job.h>

#include "aligned_sampler.h"
#include "direction_picture.h"

namespace pharos::aligned {
namespace {

std::shared_ptr<const AlignedSampler> sampler_of(const RenderConfig& config) {
  auto stated = std::dynamic_pointer_cast<const AlignedSampler>(config.sampler);
  if (stated != nullptr) return stated;
  return std::make_shared<AlignedSampler>(AlignedSettings{.base = config.sampler});
}

DirectionField directions_of(const RenderConfig& config) {
  SceneParts parts = config.scene;
  if (config.sensor != nullptr) parts.sensor = config.sensor;
  const Scene scene(parts);
  const int width = config.film.width, height = config.film.height;
  const auto sensor = scene.sensor().prepare(width, height);
  const auto integrator = config.integrator->prepare({scene, *sensor, width, height});
  return sampler_of(config)->estimate(integrator->probe().get(), config.seed);
}

/// Returns the share of regions that have at least one direction [1].
double aligned_share(const DirectionField& field, std::size_t dimension) {
  std::size_t count = 0;
  for (std::size_t region = 0; region < field.regions().count(); ++region) {
    count += field.at(dimension, region).count > 0 ? 1 : 0;
  }
  return static_cast<double>(count) / static_cast<double>(field.regions().count());
}

}  // namespace

void DirectionsCommand::Settings::describe(Schema<Settings>& s) {
  s.field("render", &Settings::render, "Render config").required();
  s.field("output", &Settings::output, "File for the picture (.png)").required();
  s.field("samples", &Settings::samples, "Samples per pixel of the image in the background")
      .at_least(1);
  s.field("scale", &Settings::scale, "Edge of a pixel of the image in the background")
      .unit("pixels")
      .at_least(1)
      .at_most(16);
  s.example("{ render: scene.yaml, output: directions.png }");
}

DirectionsCommand::DirectionsCommand(const Settings& settings) : settings_(settings) {
  if (settings.output.extension() == ".png") return;
  throw InputError(fmt::format("output: expected a name that ends in .png, found '{}'",
                               settings.output.filename().string()));
}

CommandEnd DirectionsCommand::run(const CommandControl& control) const {
  check_writable(settings_.output);
  const Registry registry = load_default_modules();
  RenderConfig config = load_render_config(settings_.render, {}, registry).config;
  config.film.crop.reset();
  config.budget = {.spp = settings_.samples};
  const DirectionField field = directions_of(config);
  if (field.dimensions().empty()) {
    throw InputError("there is nothing to align with: the scene has no light that is sampled");
  }
  RenderJob job(config);
  const RenderResult result =
      job.run({.on_progress = [&](const Progress& p) { control.progress(p.fraction); },
               .stop = control.stop});
  if (result.stopped) return CommandEnd::stopped;
  std::vector<Image> pictures;
  for (std::size_t i = 0; i < field.dimensions().size(); ++i) {
    pictures.push_back(direction_picture(result.image, field, i, settings_.scale));
    const Dimension d = field.dimensions()[i];
    control.tell(fmt::format("picture {}: {}, branch {}: {:.1f} % of {} regions have directions",
                             i + 1, Value<Purpose>::default_text(d.purpose()), d.branch(),
                             100 * aligned_share(field, i), field.regions().count()));
  }
  write_png(contact_sheet(pictures, 1), settings_.output, config.output.exposure,
            config.output.filmic);
  return CommandEnd::done;
}

}  // namespace pharos::aligned
