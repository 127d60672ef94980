#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include <pharos/core/packed_name.h>
#include <pharos/rendering/presets.h>
#include <pharos/rendering/render_config.h>
#include <pharos/rendering/scene_import.h>

namespace pharos {
namespace {

/// The most pixels of a film. Pharos can still read an image of this size with all layers.
/// Rendering it takes about 16 GiB.
constexpr std::int64_t kMostFilmPixels = std::int64_t{1} << 26;

bool is_exr_or_empty(const std::string& path) {
  return path.empty() || std::filesystem::path(path).extension() == ".exr";
}

bool has_no_duplicates(const std::vector<Layer>& layers) {
  return std::set<Layer>(layers.begin(), layers.end()).size() == layers.size();
}

/// Returns the node under a path of keys, or the deepest node on that path that exists.
const ConfigNode& nearest_node(const ConfigNode& root, std::initializer_list<const char*> keys) {
  const ConfigNode* node = &root;
  for (const char* key : keys) {
    const ConfigNode* next = node->find(key);
    if (next == nullptr) break;
    node = next;
  }
  return *node;
}

void check_film(const FilmSettings& film, const ConfigNode& node) {
  const PixelRect window = film.window();
  if (window.x1 > film.width || window.y1 > film.height) {
    nearest_node(node, {"film", "crop"})
        .fail(fmt::format("expected a window of the film of {} x {}, found one from ({}, {}) to "
                          "({}, {})",
                          film.width, film.height, window.x0, window.y0, window.x1, window.y1));
  }
  if (static_cast<std::int64_t>(window.area()) > kMostFilmPixels) {
    nearest_node(node, {"film"})
        .fail(fmt::format("a film of {} x {} has more than {} pixels", window.width(),
                          window.height(), kMostFilmPixels));
  }
}

/// Appends the files that the nodes of a config come from.
void add_sources(const ConfigNode& node, std::set<std::filesystem::path>& sources) {
  if (!node.where().file.empty()) sources.insert(node.where().file);
  for (const ConfigNode& item : node.items()) add_sources(item, sources);
  for (const ConfigNode::Entry& entry : node.entries()) add_sources(entry.value, sources);
}

/// Appends notes on what reading the scene has left out. Notes of the same text are merged.
void add_notes(std::vector<BuildContext::Note> passed_over, std::vector<ImportNote>& notes) {
  for (BuildContext::Note& note : passed_over) {
    const auto same = std::find_if(notes.begin(), notes.end(), [&](const ImportNote& known) {
      return known.message == note.message;
    });
    if (same != notes.end()) ++same->times;
    if (same == notes.end()) notes.push_back({std::move(note.where), std::move(note.message)});
  }
}

/// Checks conditions on several parameters at once.
void check_together(const RenderConfig& config, const ConfigNode& node) {
  check_film(config.film, node);
  if (config.budget.spp.has_value() == config.budget.seconds.has_value()) {
    nearest_node(node, {"budget"}).fail("expected either 'spp' or 'seconds'");
  }
  if (config.sensor == nullptr && config.scene.sensor == nullptr) {
    node.fail("there is no sensor: neither the scene nor the config has one");
  }
  const Sensor& sensor = config.sensor != nullptr ? *config.sensor : *config.scene.sensor;
  check_sensor_reach(sensor, config.film.width, config.film.height,
                     config.sensor != nullptr ? nearest_node(node, {"sensor"})
                                              : nearest_node(node, {"scene", "sensor"}));
  try {
    check_compatible(*config.integrator, sensor, config.film.jitter);
  } catch (const InputError& error) {
    nearest_node(node, {"integrator", "guiding"}).fail(error.what());
  }
}

}  // namespace

void CropSettings::describe(Schema<CropSettings>& s) {
  constexpr int kMost = 32768;
  s.field("x", &CropSettings::x, "Columns to the left of the window")
      .unit("pixels")
      .at_least(0)
      .at_most(kMost);
  s.field("y", &CropSettings::y, "Rows above the window").unit("pixels").at_least(0).at_most(kMost);
  s.field("width", &CropSettings::width, "Width")
      .unit("pixels")
      .at_least(1)
      .at_most(kMost)
      .required();
  s.field("height", &CropSettings::height, "Height")
      .unit("pixels")
      .at_least(1)
      .at_most(kMost)
      .required();
}

void FilmSettings::describe(Schema<FilmSettings>& s) {
  s.field("width", &FilmSettings::width, "Width").unit("pixels").at_least(1).at_most(32768);
  s.field("height", &FilmSettings::height, "Height").unit("pixels").at_least(1).at_most(32768);
  s.field("crop", &FilmSettings::crop, "Render only this window of the film");
  s.field(
      "jitter", &FilmSettings::jitter,
      "Whether paths pass through random points of a pixel; otherwise they all pass through its "
      "center, without anti-aliasing");
  s.field("filter", &FilmSettings::filter, "Reconstruction filter").otherwise("default");
  s.field("tile", &FilmSettings::tile, "Edge of a work unit")
      .unit("pixels")
      .at_least(1)
      .at_most(1024);
  s.field("least_weight", &FilmSettings::least_weight,
          "A pixel is divided by at least this fraction of the sum of its weights' magnitudes; for "
          "filters with negative lobes")
      .above(0)
      .at_most(1);
}

void OutputSettings::describe(Schema<OutputSettings>& s) {
  s.field("image", &OutputSettings::image,
          "EXR file, relative to the current folder; by default the config's name")
      .check("a name that ends in .exr", is_exr_or_empty);
  s.field("aovs", &OutputSettings::aovs, "Further layers of the EXR file")
      .check("each layer once", has_no_duplicates);
  s.field("model", &OutputSettings::model,
          "File for what was learned: the models of all methods, and their mixing");
  s.field("checkpoint", &OutputSettings::checkpoint,
          "File from which `pharos render --resume` goes on after the render was killed");
  s.field("every", &OutputSettings::every, "Time between two checkpoints")
      .unit("s")
      .above(0)
      .at_most(1e9);
  s.field("png", &OutputSettings::png, "Whether to write a tone-mapped PNG beside the EXR file");
  s.field("exposure", &OutputSettings::exposure, "Exposure of the PNG").unit("stops");
  s.field("filmic", &OutputSettings::filmic,
          "Whether the PNG has a filmic curve instead of clipping");
}

void RenderConfig::describe(Schema<RenderConfig>& s) {
  s.field("scene", &RenderConfig::scene, "Path of a scene file, or the scene itself").required();
  s.field("sensor", &RenderConfig::sensor, "Camera that replaces the scene's");
  s.field("film", &RenderConfig::film, "Size and filter of the image");
  s.field("sampler", &RenderConfig::sampler, "Generator of random numbers").otherwise("default");
  s.field("integrator", &RenderConfig::integrator, "Estimator of light transport")
      .otherwise("default");
  s.field("budget", &RenderConfig::budget, "Length of the render, either spp or seconds")
      .required();
  s.field("seed", &RenderConfig::seed, "Seed of all random numbers").at_least(0);
  s.field("output", &RenderConfig::output, "Files to write");
}

LoadedConfig load_render_config(const std::filesystem::path& path,
                                const std::vector<std::string>& overrides,
                                const Registry& registry) {
  std::vector<std::filesystem::path> sources;
  LoadedConfig loaded =
      build_render_config(read_config_or_scene(path, registry, &sources), overrides, registry);
  loaded.sources.insert(loaded.sources.end(), sources.begin(), sources.end());
  if (loaded.config.output.image.empty()) {
    loaded.config.output.image = unpacked_name(path).stem().string() + ".exr";
  }
  return loaded;
}

LoadedConfig build_render_config(ConfigNode node, const std::vector<std::string>& overrides,
                                 const Registry& registry) {
  // Presets are expanded at once, so that an override can change what one of them states.
  expand_preset(node, registry);
  for (const std::string& assignment : overrides) {
    apply_override(node, assignment);
    expand_preset(node, registry);
  }
  return build_render_config(node, registry);
}

LoadedConfig build_render_config(const ConfigNode& stated, const Registry& registry) {
  BuildContext context{registry};
  LoadedConfig loaded;
  ConfigNode node = stated;
  loaded.notes = expand_import(node, registry);
  expand_preset(node, registry);
  loaded.config = Value<RenderConfig>::read(node, context, loaded.resolved);
  add_notes(std::move(context.notes), loaded.notes);
  loaded.files = std::move(context.files);
  loaded.papers = std::move(context.papers);
  std::set<std::filesystem::path> sources(context.sources.begin(), context.sources.end());
  add_sources(node, sources);
  loaded.sources.assign(sources.begin(), sources.end());
  check_together(loaded.config, node);
  return loaded;
}

}  // namespace pharos
