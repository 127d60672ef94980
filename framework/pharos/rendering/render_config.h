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

/// A window of the film, all of which is on it [pixels].
struct CropSettings {
  int x = 0, y = 0;  ///< of its left upper pixel
  int width = 0, height = 0;

  static void describe(Schema<CropSettings>& schema);
};

struct FilmSettings {
  int width = 512, height = 512;
  /// The part that is rendered; the image has its size. A path is keyed by its pixel of the whole
  /// film, and work units are those of the whole film, so that pixels have the same bits in it as
  /// in the whole picture, but where the filter reaches beyond the window. What is learned is
  /// learned from the window's paths alone.
  std::optional<CropSettings> crop;
  Ref<Filter> filter;
  bool jitter = true;  ///< whether paths pass anywhere through a pixel, or through its middle
  int tile = 32;       ///< edge of a work unit [pixels]
  /// The least share of the weights' magnitude that a pixel is divided by. Filters without negative
  /// lobes never meet it, nor does Mitchell and Netravali's with B = C = 1/3; the sharper
  /// Catmull-Rom does in one of 2500 pixels of a single sample, and no longer with two.
  float least_weight = Film::kLeastWeight;

  /// What is rendered of the film.
  PixelRect window() const {
    if (!crop) return {0, 0, width, height};
    return {crop->x, crop->y, crop->x + crop->width, crop->y + crop->height};
  }

  static void describe(Schema<FilmSettings>& schema);
};

struct OutputSettings {
  std::string image;  ///< EXR, relative to the current folder; the PNG stands beside it
  std::vector<Layer> aovs;
  std::string model;  ///< learned model of the first method; empty: not written
  bool png = true;
  float exposure = 0;  ///< of the PNG [stops]
  bool filmic = true;  ///< of the PNG

  static void describe(Schema<OutputSettings>& schema);
};

/// Everything that determines a render.
struct RenderConfig {
  SceneParts scene;
  Ref<Sensor> sensor;  ///< instead of the scene's; may be null
  FilmSettings film;
  Ref<Sampler> sampler;
  Ref<Integrator> integrator;
  Budget budget;
  std::uint64_t seed = 1;
  OutputSettings output;

  static void describe(Schema<RenderConfig>& schema);
};

/// A config with the text of all values in force.
struct LoadedConfig {
  RenderConfig config;
  ConfigNode resolved;                       ///< parses to the same config
  std::vector<std::filesystem::path> files;  ///< meshes, images and the like that it names
  std::vector<ImportNote> notes;             ///< how a scene of another program was approximated
};

/// Reads a render config, or a scene that an importer reads, follows `extends`, applies `overrides`
/// ("a.b=c") in order, builds every component and checks that they fit together. Throws InputError;
/// writes nothing.
LoadedConfig load_render_config(const std::filesystem::path& path,
                                const std::vector<std::string>& overrides,
                                const Registry& registry);
/// The same from a node that was read or made elsewhere.
LoadedConfig build_render_config(const ConfigNode& node, const Registry& registry);

}  // namespace pharos
