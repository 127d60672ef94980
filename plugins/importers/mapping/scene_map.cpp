#include "scene_map.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>

#include <fmt/core.h>

#include <pharos/config/values.h>

namespace pharos::mitsuba {
namespace {

constexpr int kDeepest = 64;

bool may_stand_in_names(char c) {
  const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  return letter || c == '_' || c == '-' || static_cast<unsigned char>(c) >= 0x80;
}

/// Returns whether a config would not read the word as a name, or uses it as its own key.
bool is_taken_word(const std::string& name) {
  static constexpr std::array<std::string_view, 12> words{"",      "null",  "Null",    "NULL",
                                                          "true",  "True",  "TRUE",    "false",
                                                          "False", "FALSE", "default", "-"};
  return std::find(words.begin(), words.end(), name) != words.end() || is_number(name);
}

}  // namespace

SceneMap::SceneMap(const Document& document) : document_(document) {
  for (const ImportNote& note : document.notes) {
    note_index_[note.message] = result_.notes.size();
    result_.notes.push_back(note);
  }
}

std::string describe(const Object& object) {
  std::string text = object.tag;
  if (!object.type.empty()) text += " " + object.type;
  if (!object.id.empty()) text += " '" + object.id + "'";
  return text;
}

void SceneMap::note(const Location& where, const std::string& message) {
  const auto [found, is_new] = note_index_.try_emplace(message, result_.notes.size());
  if (is_new) {
    result_.notes.push_back({where, message});
  } else {
    ++result_.notes[found->second].times;
  }
}

SceneMap::Entry::Entry(SceneMap& map, const Object& object)
    : map_(map), index_(map.result_.objects.size()) {
  if (map_.depth_ >= kDeepest) {
    throw InputError(object.where,
                     fmt::format("objects are nested deeper than {} levels", kDeepest));
  }
  ++map_.depth_;
  map_.result_.objects.push_back({object.where, describe(object), "nothing"});
}

bool SceneMap::depends_on_uv(const Object& object) {
  if (object.tag == "texture") return true;
  const auto known = uv_dependence_.find(&object);
  if (known != uv_dependence_.end()) return known->second;
  bool& depends = uv_dependence_[&object];
  for (const Property& p : object.properties) {
    const auto* nested = std::get_if<std::shared_ptr<const Object>>(&p.value);
    if (nested != nullptr && depends_on_uv(**nested)) return depends = true;
  }
  return false;
}

ConfigNode SceneMap::file_node(const std::string& name, const Location& where) const {
  std::string slashes = name;
  std::replace(slashes.begin(), slashes.end(), '\\', '/');
  const std::filesystem::path path(slashes);
  const std::filesystem::path beside = std::filesystem::path(where.file).parent_path();
  const auto is_in = [&](const std::filesystem::path& folder) {
    std::error_code failed;
    return std::filesystem::exists(folder / path, failed);
  };
  // Nodes are read relative to the file that contains them.
  if (path.is_absolute() || is_in(beside)) return ConfigNode::scalar(slashes, where);
  std::filesystem::path folder = document_.folder;
  for (const std::filesystem::path& resource : document_.resource_folders) {
    if (!is_in(resource)) continue;
    folder = resource;
    break;
  }
  if (folder == beside) return ConfigNode::scalar(slashes, where);
  return ConfigNode::scalar(std::filesystem::absolute(folder / path).string(), where);
}

std::string SceneMap::free_name(Dictionary& dictionary, const std::string& id) {
  std::string base = id;
  for (char& c : base) {
    if (!may_stand_in_names(c)) c = '_';
  }
  if (is_taken_word(base)) base = dictionary.word + (base.empty() ? "" : "_") + base;
  std::string name = base;
  for (int i = 2; !dictionary.taken.insert(name).second; ++i) {
    name = fmt::format("{}_{}", base, i);
  }
  return name;
}

}  // namespace pharos::mitsuba
