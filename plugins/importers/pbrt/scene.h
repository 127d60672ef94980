#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <pharos/config/node.h>
#include <pharos/core/error.h>
#include <pharos/scene/importer.h>

#include "../shared/import_log.h"
#include "../shared/read_file.h"
#include "colors.h"
#include "graphics_state.h"

namespace pharos::pbrt {

/// The types of textures, whose names are independent of each other: "float" and "spectrum".
enum class TextureKind { number, spectrum };

/// A texture of the scene.
struct NamedTexture {
  std::string name;  ///< in the config
  /// Returns the mean of its values and channels, if it is known.
  std::function<std::optional<double>()> average = [] { return std::nullopt; };
};

/// A scene under construction: the current state, and what the directives so far have defined.
class Scene {
 public:
  Scene(std::filesystem::path folder, importing::ReadingBudget& budget);

  GraphicsState& state() { return state_; }
  const GraphicsState& state() const { return state_; }

  void note(const Location& where, const std::string& message) { log_.note(where, message); }
  importing::ImportLog& log() { return log_; }

  Color color(const Parameter& parameter, ColorRole role) const {
    return colors_.read(parameter, role, state_.space);
  }
  const std::filesystem::path& folder() const { return folder_; }
  /// Returns the node of a file that the scene names.
  ConfigNode file_node(const std::string& name, const Location& where) const;

  /// Defines a texture. Throws InputError if it exists already.
  void add_texture(TextureKind kind, const std::string& name, const Location& where,
                   ConfigNode node, std::function<std::optional<double>()> average);
  /// Returns the texture that a parameter of type "texture" refers to, of `kind` or else of the
  /// other one. Throws InputError with the nearest name if there is none.
  const NamedTexture& texture(const Parameter& parameter, TextureKind kind) const;

  /// Defines a material without a name and returns its entry.
  std::string add_material(const Location& where, ConfigNode node);
  /// Defines a named material. Throws InputError if it exists already.
  void define_material(const std::string& name, const Location& where, ConfigNode node);
  /// Whether a material that was defined before is an invisible surface.
  bool is_interface(const std::string& entry) const;
  /// Returns the entry of a named material, which may be defined later.
  std::string material(const std::string& name, const Location& where);

  /// Defines a medium, or without a node one that is left out.
  void define_medium(const std::string& name, const Location& where,
                     std::optional<ConfigNode> node);
  /// Returns the entry of a named medium; empty for vacuum and for media that are left out.
  std::string medium(const std::string& name, const Location& where) const;

  /// Keeps the error of a definition that failed. It is thrown again wherever the name is used.
  /// `what` is "texture" or "medium".
  void add_failed(const char* what, const std::string& name, const InputError& error) {
    failed_.emplace(std::pair(what, name), error);
  }

  /// Begins and ends the definition of an object, to which add_shape() then adds.
  void begin_object(const std::string& name, const Location& where);
  void end_object(const Location& where);
  bool is_in_object() const { return object_ != nullptr; }
  /// Returns the entry of an object. Throws InputError with the nearest name if there is none.
  std::string object(const std::string& name, const Location& where) const;

  void add_shape(ConfigNode node);
  void add_emitter(ConfigNode node) { emitters_.items().push_back(std::move(node)); }

  /// The parts of the config that come from Camera, Film, Sampler, PixelFilter and Integrator.
  ConfigNode sensor, film, sampler, integrator, budget, medium_of_camera;

  /// Returns the config of the scene. Throws InputError for materials that were never defined.
  Import finished();

 private:
  struct Entry {
    std::string name;
    Location where;  ///< of the first mention
    bool is_defined = false;
  };
  struct Group {
    std::string entry;
    ConfigNode shapes;
  };

  [[noreturn]] void fail_unknown(const Location& where, const char* what, const std::string& name,
                                 const std::vector<std::string>& known) const;
  std::string material_entry(const std::string& name, const Location& where, bool defines);
  void append_material(const std::string& entry, const Location& where, ConfigNode node);

  std::filesystem::path folder_;
  ColorReader colors_;
  importing::ImportLog log_;
  GraphicsState state_;
  importing::EntryNames texture_names_{"texture"}, material_names_{"material"},
      medium_names_{"medium"}, group_names_{"object"};
  std::map<std::pair<std::string, TextureKind>, NamedTexture> textures_by_name_;
  std::map<std::string, Entry> materials_by_name_;
  std::set<std::string> interfaces_;  ///< entries of materials
  std::map<std::string, std::string> media_by_name_;
  std::map<std::string, Group> objects_;
  std::vector<std::string> order_of_objects_;
  std::map<std::pair<std::string, std::string>, InputError> failed_;  ///< by kind and name
  Group* object_ = nullptr;
  ConfigNode textures_ = ConfigNode::mapping(), materials_ = ConfigNode::mapping(),
             media_ = ConfigNode::mapping(), shapes_ = ConfigNode::sequence(),
             emitters_ = ConfigNode::sequence();
};

}  // namespace pharos::pbrt
