#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <pharos/config/registry.h>
#include <pharos/guiding/budget.h>
#include <pharos/rendering/film.h>
#include <pharos/rendering/filter.h>
#include <pharos/rendering/integrator.h>
#include <pharos/scene/importer.h>
#include <pharos/scene/scene_loader.h>

namespace pharos {

struct FilmSettings {
  int width = 512, height = 512;
  Ref<Filter> filter;
  int tile = 32;  ///< edge of a work unit [pixels]
  /// The least share of the weights' magnitude that a pixel is divided by. Filters without negative
  /// lobes never meet it, nor does Mitchell and Netravali's with B = C = 1/3; the sharper
  /// Catmull-Rom does in one of 2500 pixels of a single sample, and no longer with two.
  float least_weight = Film::kLeastWeight;

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
