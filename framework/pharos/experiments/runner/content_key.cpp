#include <cctype>
#include <fstream>
#include <set>
#include <sstream>
#include <xxhash.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <pharos/core/error.h>
#include <pharos/core/uri.h>
#include <pharos/experiments/runner/content_key.h>

namespace pharos {
namespace {

/// Returns the files that hold the buffers of a mesh file in the text form of glTF; none for other
/// forms.
std::vector<std::filesystem::path> buffers_of(const std::filesystem::path& mesh) {
  std::vector<std::filesystem::path> files;
  std::string extension = mesh.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension != ".gltf") return files;
  std::ifstream in(mesh);
  const auto document = nlohmann::json::parse(in, nullptr, false);
  if (!document.is_object() || !document.contains("buffers")) return files;
  for (const auto& buffer : document["buffers"]) {
    if (!buffer.is_object() || !buffer.contains("uri") || !buffer["uri"].is_string()) continue;
    const std::string uri = buffer["uri"];
    if (!uri.starts_with("data:")) files.push_back(mesh.parent_path() / percent_decoded(uri));
  }
  return files;
}

/// Returns the key of a file and of the files that it refers to.
std::string key_of_input(const std::filesystem::path& path) {
  const std::vector<std::filesystem::path> buffers = buffers_of(path);
  std::string keys = content_key_of_file(path);
  if (buffers.empty()) return keys;
  for (const std::filesystem::path& buffer : buffers) keys += content_key_of_file(buffer);
  return content_key(keys);
}

/// Replaces every scalar that is a path in `files` by the key of the file.
void replace_paths(ConfigNode& node, const std::set<std::string>& files) {
  if (node.is_scalar() && files.contains(node.text())) {
    node = ConfigNode::scalar(key_of_input(node.text()));
  }
  for (ConfigNode& item : node.items()) replace_paths(item, files);
  for (ConfigNode::Entry& entry : node.entries()) replace_paths(entry.value, files);
}

}  // namespace

std::string content_key(std::string_view text) {
  const XXH128_hash_t hash = XXH3_128bits(text.data(), text.size());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::string pixels_key(const Image& image) {
  const std::vector<float>& values = image.values();
  return content_key({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)});
}

std::string content_key_of_file(const std::filesystem::path& path) {
  const std::string problem = access_problem(path);
  std::ifstream in(path, std::ios::binary);
  std::ostringstream content;
  content << in.rdbuf();
  if (!problem.empty() || !in || in.bad()) {
    throw RunError(fmt::format("{}: error: cannot be read{}", path.string(),
                               problem.empty() ? "" : ": " + problem));
  }
  return content_key(content.str());
}

std::vector<std::filesystem::path> inputs_of(const LoadedConfig& loaded) {
  std::vector<std::filesystem::path> inputs = loaded.sources;
  for (const std::filesystem::path& file : loaded.files) {
    inputs.push_back(file);
    for (std::filesystem::path& buffer : buffers_of(file)) inputs.push_back(std::move(buffer));
  }
  return inputs;
}

ConfigNode content_of(const LoadedConfig& loaded) {
  std::set<std::string> files;
  for (const std::filesystem::path& file : loaded.files) files.insert(file.string());
  ConfigNode node = loaded.resolved;
  node.take("output");
  replace_paths(node, files);
  return node;
}

std::string content_key(const LoadedConfig& loaded) {
  return content_key(to_yaml(content_of(loaded)));
}

}  // namespace pharos
