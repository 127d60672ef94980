#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <pharos/config/registry.h>
#include <pharos/rendering/budget.h>
#include <pharos/rendering/film.h>
#include <pharos/rendering/filter.h>
#include <pharos/rendering/integrator.h>
#include <pharos/scene/importer.h>
#include <pharos/scene/scene_loader.h>

namespace pharos {

/// A window that lies on the film as a whole [pixels].
struct CropSettings {
  int x = 0, y = 0;  ///< its upper left pixel
  int width = 0, height = 0;

  static void describe(Schema<CropSettings>& schema);
};

struct FilmSettings {
  int width = 512, height = 512;
  /// The window that is rendered; the image has its size. Paths have the same keys and work units
  /// as in a render of the whole film. Pixels therefore have the same bits as in the whole picture,
  /// except where the filter reaches beyond the window. Guides learn from the window's paths alone.
  std::optional<CropSettings> crop;
  Ref<Filter> filter;
  bool jitter = true;  ///< paths pass through random points of a pixel, or else through its center
  int tile = 32;       ///< edge of a work unit [pixels]
  /// The least fraction of the sum of the weights' magnitudes that a pixel is divided by. Filters
  /// without negative lobes never reach it, and neither does the filter of Mitchell and Netravali
  /// with B = C = 1/3. The sharper Catmull-Rom filter reaches it in one of 2500 pixels with a
  /// single sample, but no longer with two samples.
  float least_weight = Film::kLeastWeight;

  /// Returns the part of the film that is rendered.
  PixelRect window() const {
    if (!crop) return {0, 0, width, height};
    return {crop->x, crop->y, crop->x + crop->width, crop->y + crop->height};
  }

  static void describe(Schema<FilmSettings>& schema);
};

struct OutputSettings {
  std::string image;  ///< EXR file, relative to the current folder; the PNG is written beside it
  std::vector<Layer> aovs;
  std::string model;       ///< file for what was learned; empty: not written
  std::string checkpoint;  ///< file from which a killed render goes on; empty: not written
  double every = 300;      ///< time between two checkpoints [s]
  bool png = true;
  float exposure = 0;   ///< exposure of the PNG [stops]
  bool filmic = false;  ///< whether the PNG has a filmic curve

  static void describe(Schema<OutputSettings>& schema);
};

/// Everything that determines a render.
struct RenderConfig {
  SceneParts scene;
  Ref<Sensor> sensor;  ///< replaces the scene's sensor; may be null
  FilmSettings film;
  Ref<Sampler> sampler;
  Ref<Integrator> integrator;
  Budget budget;
  std::uint64_t seed = 1;
  OutputSettings output;

  static void describe(Schema<RenderConfig>& schema);
};

/// A render config together with its resolved text.
struct LoadedConfig {
  RenderConfig config;
  ConfigNode resolved;                       ///< all values in force; parses to the same config
  std::vector<std::filesystem::path> files;  ///< files that it names, such as meshes and images
  /// The files that hold the config itself: configs, scenes, presets, and all that they extend or
  /// include.
  std::vector<std::filesystem::path> sources;
  /// Notes on what reading the scene has approximated or left out.
  std::vector<ImportNote> notes;
  std::vector<std::string> papers;  ///< to be cited for the plugins in use, see Registry::add
};

/// Loads a render config, or a scene that an importer reads. Follows `extends`, applies `overrides`
/// ("a.b=c") in order, builds every component and checks that they fit together. Throws InputError
/// and writes nothing.
LoadedConfig load_render_config(const std::filesystem::path& path,
                                const std::vector<std::string>& overrides,
                                const Registry& registry);
/// Builds a render config from a node that was read or made elsewhere.
LoadedConfig build_render_config(const ConfigNode& node, const Registry& registry);
/// The same with `overrides` ("a.b=c"), which are applied in order.
LoadedConfig build_render_config(ConfigNode node, const std::vector<std::string>& overrides,
                                 const Registry& registry);

}  // namespace pharos
