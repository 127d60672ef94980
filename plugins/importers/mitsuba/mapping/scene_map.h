#pragma once

#include <map>
#include <string>
#include <utility>

#include <pharos/scene/importer.h>

#include "../../shared/import_log.h"
#include "../document/document.h"

namespace pharos::mitsuba {

/// The relation of a shape's texture coordinates in Pharos to those in Mitsuba.
enum class UvSense {
  same,
  v_flipped,  ///< v in Pharos is 1 - v in Mitsuba
};

/// A Pharos scene under construction: the data that all parts share during the mapping.
class SceneMap {
 public:
  /// Starts with the notes from reading the file.
  explicit SceneMap(const Document& document);

  /// Adds a note to the import. Notes with the same message are counted instead of repeated.
  void note(const Location& where, const std::string& message) { log_.note(where, message); }

  /// Records an object of the scene file in the list of objects. Throws InputError if objects are
  /// nested deeper than 64; the entry counts as a level while it lives. done() states the result
  /// for the object.
  class Entry {
   public:
    Entry(SceneMap& map, const Object& object);
    ~Entry() { --map_.depth_; }
    Entry(const Entry&) = delete;
    Entry& operator=(const Entry&) = delete;
    void done(std::string stands) { map_.log_.stands(index_, std::move(stands)); }

   private:
    SceneMap& map_;
    std::size_t index_;
  };

  /// A dictionary of the scene: `textures`, `materials`, `media` or `groups`.
  struct Dictionary {
    importing::EntryNames free_names;
    ConfigNode entries = ConfigNode::mapping();
    std::map<std::pair<const Object*, UvSense>, std::string> names = {};
    std::map<std::pair<const Object*, UvSense>, InputError> failed = {};
  };
  Dictionary& textures() { return textures_; }
  Dictionary& materials() { return materials_; }
  Dictionary& media() { return media_; }
  Dictionary& groups() { return groups_; }

  /// Returns the name of the object in `dictionary`. At the first request `make()` maps it and
  /// returns its node. If that throws an InputError, so do all further requests. `sense` matters
  /// only for objects with textures.
  template <class Make>
  std::string name_in(Dictionary& dictionary, const Object& object, UvSense sense,
                      const Make& make) {
    if (!depends_on_uv(object)) sense = UvSense::same;
    const auto found = dictionary.names.find({&object, sense});
    if (found != dictionary.names.end()) return found->second;
    const auto failed = dictionary.failed.find({&object, sense});
    if (failed != dictionary.failed.end()) throw InputError(failed->second);
    ConfigNode node;
    try {
      node = make();  // records the objects it refers to before this one
    } catch (const InputError& error) {
      dictionary.failed.emplace(std::pair(&object, sense), error);
      throw;
    }
    std::string name = dictionary.free_names.take(object.id);
    dictionary.names[{&object, sense}] = name;
    dictionary.entries.entries().push_back({name, object.where, std::move(node)});
    return name;
  }

  /// Returns true for textures and for everything that contains textures.
  bool depends_on_uv(const Object& object);

  /// Returns the node of a file name. The file may be beside the file that names it, in the scene's
  /// resource folders, or beside the scene file.
  ConfigNode file_node(const std::string& name, const Location& where) const;

  const Document& document() const { return document_; }
  /// The import so far.
  Import& result() { return log_.result(); }

 private:
  static Dictionary named(const char* word) { return {.free_names = importing::EntryNames(word)}; }

  const Document& document_;
  importing::ImportLog log_;
  std::map<const Object*, bool> uv_dependence_;
  int depth_ = 0;
  Dictionary textures_ = named("texture"), materials_ = named("material"), media_ = named("medium"),
             groups_ = named("group");
};

/// Describes an object, such as "bsdf roughplastic 'Lamp'".
std::string describe(const Object& object);

}  // namespace pharos::mitsuba
