#include <fstream>
#include <iterator>
#include <set>
#include <xxhash.h>

#include <fmt/format.h>

#include <pharos/core/error.h>
#include <pharos/experiments/content_key.h>

namespace pharos {
namespace {

std::string key_of_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw RunError(fmt::format("{}: error: cannot be read", path.string()));
  return content_key(content);
}

/// Replaces every scalar that is the path of one of `files` by what is in it.
void replace_paths(ConfigNode& node, const std::set<std::string>& files) {
  if (node.is_scalar() && files.contains(node.text())) {
    node = ConfigNode::scalar(key_of_file(node.text()));
  }
  for (ConfigNode& item : node.items()) replace_paths(item, files);
  for (ConfigNode::Entry& entry : node.entries()) replace_paths(entry.value, files);
}

}  // namespace

std::string content_key(std::string_view text) {
  const XXH128_hash_t hash = XXH3_128bits(text.data(), text.size());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::string content_key(const LoadedConfig& loaded) {
  std::set<std::string> files;
  for (const std::filesystem::path& file : loaded.files) files.insert(file.string());
  ConfigNode node = loaded.resolved;
  node.take("output");
  replace_paths(node, files);
  return content_key(to_yaml(node));
}

}  // namespace pharos
