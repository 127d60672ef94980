#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>

#include <pharos/scene/importer.h>

#include "../document/document.h"

namespace pharos::mitsuba {

/// How a shape's texture coordinates here compare with Mitsuba's.
enum class UvSense {
  same,
  v_flipped,  ///< v here is 1 - v there
};

/// A Pharos scene in the making: what its parts share while they are mapped one by one.
class SceneMap {
 public:
  /// Begins with the notes of reading the file.
  explicit SceneMap(const Document& document);

  /// Tells the reader of the import; notes of the same message are counted, not repeated.
  void note(const Location& where, const std::string& message);

  /// Enters an object of the scene file into the list of objects, and guards against objects that
  /// are nested deeper than 64 for as long as it lives; done() says what stands for the object.
  class Entry {
   public:
    Entry(SceneMap& map, const Object& object);
    ~Entry() { --map_.depth_; }
    Entry(const Entry&) = delete;
    Entry& operator=(const Entry&) = delete;
    void done(std::string stands) { map_.result_.objects[index_].stands = std::move(stands); }

   private:
    SceneMap& map_;
    std::size_t index_;
  };

  /// A dictionary of the scene: `textures`, `materials`, `media` or `groups`.
  struct Dictionary {
    std::string word;  ///< "texture"; stands before ids that cannot be names
    ConfigNode entries = ConfigNode::mapping();
    std::map<std::pair<const Object*, UvSense>, std::string> names = {};
    std::set<std::string> taken = {};
  };
  Dictionary& textures() { return textures_; }
  Dictionary& materials() { return materials_; }
  Dictionary& media() { return media_; }
  Dictionary& groups() { return groups_; }

  /// The name under which `dictionary` has the object. It is mapped by `make()`, which returns its
  /// node, when it is asked for the first time; `sense` matters to objects with textures alone.
  template <class Make>
  std::string name_in(Dictionary& dictionary, const Object& object, UvSense sense,
                      const Make& make) {
    if (!depends_on_uv(object)) sense = UvSense::same;
    const auto found = dictionary.names.find({&object, sense});
    if (found != dictionary.names.end()) return found->second;
    ConfigNode node = make();  // enters what it refers to itself, before this
    std::string name = free_name(dictionary, object.id);
    dictionary.names[{&object, sense}] = name;
    dictionary.entries.entries().push_back({name, object.where, std::move(node)});
    return name;
  }

  /// True for textures and everything that has some.
  bool depends_on_uv(const Object& object);

  /// The node of a file's name, which may stand beside the file that names it, in the scene's
  /// resource folders, or beside the scene file.
  ConfigNode file_node(const std::string& name, const Location& where) const;

  const Document& document() const { return document_; }
  /// The import so far.
  Import& result() { return result_; }

 private:
  static std::string free_name(Dictionary& dictionary, const std::string& id);

  const Document& document_;
  Import result_;
  std::map<std::string, std::size_t> note_index_;
  std::map<const Object*, bool> uv_dependence_;
  int depth_ = 0;
  Dictionary textures_{"texture"}, materials_{"material"}, media_{"medium"}, groups_{"group"};
};

/// "bsdf roughplastic 'Lamp'".
std::string describe(const Object& object);

}  // namespace pharos::mitsuba
