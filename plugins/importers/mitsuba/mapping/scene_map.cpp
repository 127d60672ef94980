#include "scene_map.h"

#include <algorithm>
#include <system_error>

#include <fmt/core.h>

namespace pharos::mitsuba {
namespace {

constexpr int kDeepestNesting = 64;

}  // namespace

SceneMap::SceneMap(const Document& document) : document_(document), log_(document.notes) {}

std::string describe(const Object& object) {
  std::string text = object.tag;
  if (!object.type.empty()) text += " " + object.type;
  if (!object.id.empty()) text += " '" + object.id + "'";
  return text;
}

SceneMap::Entry::Entry(SceneMap& map, const Object& object) : map_(map), index_(0) {
  if (map_.depth_ >= kDeepestNesting) {
    throw InputError(object.where,
                     fmt::format("objects are nested deeper than {} levels", kDeepestNesting));
  }
  ++map_.depth_;
  index_ = map_.log_.add_object(object.where, describe(object));
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

}  // namespace pharos::mitsuba
