// pbrt: scenes of pbrt-v4. statements.h reads the directives, this file follows the state that they
// change, and mapping.h maps each object; docs/pbrt.md lists what is supported and approximated.
#include "pbrt_importer.h"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "mapping.h"
#include "scene.h"
#include "statements.h"
#include "transforms.h"

namespace pharos {
namespace {

using namespace pbrt;

/// Calls `read` and locates its error at the directive.
template <class Read>
void locate(const Statement& s, Read&& read) {
  try {
    read();
  } catch (const InputError& e) {
    if (e.located()) throw;
    throw InputError(s.where, e.what());
  }
}

/// Follows the directives of a scene. The errors of its objects are thrown together; an error of
/// the file's structure is the last one.
class SceneReader {
 public:
  explicit SceneReader(const std::filesystem::path& file)
      : scene_(file.parent_path(), budget_), statements_(file, budget_) {}

  Import read() {
    errors_.attempt([&] { follow_all(); });
    errors_.raise();
    return scene_.finished();
  }

 private:
  /// A state to return to, and the directive that saved it.
  struct Saved {
    Statement begin;
    GraphicsState state;
  };

  void follow_all() {
    while (std::optional<Statement> statement = statements_.next()) {
      locate(*statement, [&] { obey(*statement); });
    }
    if (!saved_.empty()) {
      throw InputError(statements_.end(),
                       fmt::format("the {} in line {} has no end", saved_.back().begin.word,
                                   saved_.back().begin.where.line));
    }
    if (!is_in_world_) map_view(scene_, view_);
  }

  void obey(const Statement& s) {
    if (is_transform(s)) {
      if (state().moves_start) {
        state().to_world = transformed(state().to_world, s, spaces_);
      } else {
        scene_.note(s.where, "transforms of the end of the exposure are left out");
      }
    } else if (!obey_view(s) && !obey_block(s)) {
      errors_.attempt([&] {
        locate(s, [&] {
          if (!obey_state(s)) obey_object(s);
        });
      });
    }
  }

  GraphicsState& state() { return scene_.state(); }

  /// Directives before WorldBegin.
  bool obey_view(const Statement& s) {
    const std::pair<const char*, std::optional<Statement>*> parts[] = {
        {"Camera", &view_.camera},
        {"Film", &view_.film},
        {"PixelFilter", &view_.filter},
        {"Sampler", &view_.sampler},
        {"Integrator", &view_.integrator}};
    for (const auto& [word, place] : parts) {
      if (s.word != word) continue;
      if (is_in_world_) throw InputError(s.where, s.word + " must stand before WorldBegin");
      *place = s;
      if (s.word == "Camera") place_camera();
      return true;
    }
    if (s.word == "Option" && s.type() == "forcediffuse" && s.texts.back() == "true") {
      scene_.note(s.where, "the option 'forcediffuse' is left out");
    }
    if (s.word == "Accelerator" || s.word == "Option") return true;
    if (s.word != "WorldBegin") return false;
    if (is_in_world_) throw InputError(s.where, "WorldBegin stands twice");
    errors_.attempt([&] { locate(s, [&] { map_view(scene_, view_); }); });
    is_in_world_ = true;
    state().to_world = Transform();
    state().moves_start = true;
    spaces_["world"] = Transform();
    return true;
  }

  void place_camera() {
    view_.camera_to_world = inverse(state().to_world);
    view_.camera_medium = state().outside;
    spaces_["camera"] = view_.camera_to_world;
  }

  /// Directives that save and restore the state.
  bool obey_block(const Statement& s) {
    if (s.word == "AttributeBegin" || s.word == "TransformBegin" || s.word == "ObjectBegin") {
      saved_.push_back({s, state()});
      if (s.word == "ObjectBegin") scene_.begin_object(s.type(), s.where);
      return true;
    }
    if (s.word != "AttributeEnd" && s.word != "TransformEnd" && s.word != "ObjectEnd") return false;
    const std::string begin = s.word.substr(0, s.word.size() - 3) + "Begin";
    if (saved_.empty() || saved_.back().begin.word != begin) {
      throw InputError(s.where,
                       saved_.empty()
                           ? fmt::format("{} without {}", s.word, begin)
                           : fmt::format("{} where the {} in line {} must end first", s.word,
                                         saved_.back().begin.word, saved_.back().begin.where.line));
    }
    state() = std::move(saved_.back().state);
    if (s.word == "ObjectEnd") scene_.end_object(s.where);
    saved_.pop_back();
    return true;
  }

  /// Directives that change the state.
  bool obey_state(const Statement& s) {
    if (s.word == "ReverseOrientation") {
      state().reverse_orientation = !state().reverse_orientation;
    } else if (s.word == "Attribute") {
      add_attributes(s);
    } else if (s.word == "ColorSpace") {
      set_color_space(s);
    } else if (s.word == "Material") {
      state().material = scene_.add_material(s.where, map_material(scene_, s));
    } else if (s.word == "NamedMaterial") {
      state().material = scene_.material(s.type(), s.where);
    } else if (s.word == "AreaLightSource") {
      state().area_light = s.type().empty()
                               ? nullptr
                               : std::make_shared<const ConfigNode>(map_area_light(scene_, s));
    } else if (s.word == "MediumInterface") {
      state().inside = s.texts.front();
      state().outside = s.texts.back();
    } else if (s.word == "CoordinateSystem") {
      spaces_[s.type()] = state().to_world;
    } else if (s.word == "ActiveTransform") {
      state().moves_start = s.type() != "EndTime";
    } else if (s.word == "TransformTimes") {
      scene_.note(s.where, "nothing moves: objects stand where they are at the start");
    } else {
      return false;
    }
    return true;
  }

  void add_attributes(const Statement& s) {
    const std::vector<std::string> known{"shape", "light", "material", "medium", "texture"};
    if (std::find(known.begin(), known.end(), s.type()) == known.end()) {
      throw InputError(
          s.where, fmt::format("Attribute has no target '{}'{}; known: {}", one_line(s.type(), 60),
                               suggestion(s.type(), known), quoted_list(known)));
    }
    std::map<std::string, Parameters> attributes;
    if (state().attributes != nullptr) attributes = *state().attributes;
    Parameters& all = attributes[s.type()];
    all.insert(all.end(), s.parameters.begin(), s.parameters.end());  // the last one counts
    state().attributes =
        std::make_shared<const std::map<std::string, Parameters>>(std::move(attributes));
  }

  void set_color_space(const Statement& s) {
    try {
      state().space = color_space(s.type());
    } catch (const InputError& e) {
      throw InputError(s.where, e.what());
    }
  }

  void obey_object(const Statement& s) {
    try {
      locate(s, [&] { add_object(s); });
    } catch (const InputError& error) {
      if (s.word == "Texture") scene_.add_failed("texture", s.type(), error);
      if (s.word == "MakeNamedMedium") scene_.add_failed("medium", s.type(), error);
      throw;
    }
  }

  /// Directives that define something or add it to the scene.
  void add_object(const Statement& s) {
    if (s.word == "MakeNamedMedium") return map_medium(scene_, s);
    if (s.word == "MakeNamedMaterial") {
      return scene_.define_material(s.type(), s.where, map_material(scene_, s));
    }
    if (s.word == "Texture") return map_texture(scene_, s);
    if (!is_in_world_) throw InputError(s.where, s.word + " must stand after WorldBegin");
    if (s.word == "LightSource") return map_light(scene_, s);
    if (s.word == "Shape") return map_shape(scene_, s);
    add_instance(s);
  }

  void add_instance(const Statement& s) {
    if (scene_.is_in_object()) throw InputError(s.where, "ObjectInstance within an object");
    const std::string entry = scene_.object(s.type(), s.where);
    if (entry.empty()) return;
    ConfigNode node = importing::plugin_node("instance", s.where);
    node.set("group", importing::text_node(entry, s.where), s.where);
    node.set("to_world", importing::transform_node(state().to_world, s.where), s.where);
    scene_.add_shape(std::move(node));
  }

  importing::ReadingBudget budget_;
  Scene scene_;
  StatementReader statements_;
  View view_;
  std::map<std::string, Transform> spaces_;  ///< by CoordinateSystem
  std::vector<Saved> saved_;
  bool is_in_world_ = false;
  InputErrorList errors_;
};

}  // namespace

Import PbrtImporter::import(const std::filesystem::path& file) const {
  return SceneReader(file).read();
}

}  // namespace pharos
