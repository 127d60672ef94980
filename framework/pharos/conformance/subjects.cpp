#include <algorithm>
#include <cmath>
#include <fstream>
#include <unistd.h>

#include <pharos/conformance/subjects.h>
#include <pharos/core/error.h>
#include <pharos/core/image.h>

namespace pharos::conformance {
namespace {

namespace fs = std::filesystem;

/// A Hammersley set of eight points, centered in their strata.
constexpr const char* kExamplePoints = R"(0.0625 0.0625
0.1875 0.5625
0.3125 0.3125
0.4375 0.8125
0.5625 0.1875
0.6875 0.6875
0.8125 0.4375
0.9375 0.9375
)";

/// An octahedron with smooth shading normals.
constexpr const char* kExamplePly = R"(ply
format ascii 1.0
element vertex 6
property float x
property float y
property float z
property float nx
property float ny
property float nz
element face 8
property list uchar int vertex_indices
end_header
1 0 0 1 0 0
-1 0 0 -1 0 0
0 1 0 0 1 0
0 -1 0 0 -1 0
0 0 1 0 0 1
0 0 -1 0 0 -1
3 0 2 4
3 2 1 4
3 1 3 4
3 3 0 4
3 2 0 5
3 1 2 5
3 3 1 5
3 0 3 5
)";

/// Returns a map of the sphere of directions: a sky that brightens upwards, with a small sun.
Image example_sky() {
  Image image(32, 16, {"R", "G", "B"});
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 32; ++x) {
      const float up = 1 - (static_cast<float>(y) + 0.5f) / 16;
      const bool sun = y == 4 && (x == 20 || x == 21);
      image.set_rgb(x, y, sun ? Rgb(80, 70, 50) : Rgb(0.2f * up, 0.3f * up, 0.1f + 0.5f * up));
    }
  }
  return image;
}

Image example_picture() {
  Image image(16, 16, {"R", "G", "B"});
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      const float wave = 0.5f + 0.5f * std::sin(0.9f * static_cast<float>(x * y % 7 + x));
      image.set_rgb(x, y, {0.9f * wave, 0.05f * static_cast<float>(y), 0.5f});
    }
  }
  return image;
}

/// Builds cases one by one and keeps those that can be built.
class CaseBuilder {
 public:
  CaseBuilder(const Registry& registry, const PluginInfo& plugin, const fs::path& folder)
      : registry_(registry), plugin_(plugin), where_{(folder / "example.yaml").string(), 1, 1} {}

  /// Adds the case of a YAML mapping. If it cannot be built, adds the reason to `failures`.
  void add(const std::string& yaml, std::vector<std::string>& failures) {
    try {
      add(parse_yaml_at(yaml, where_));
    } catch (const Error& e) {
      failures.push_back(yaml + ": " + without_folder(e.what()));
    }
  }

  /// Adds the first case with every other value of `parameter`.
  void vary(const ParameterInfo& parameter) {
    if (cases.subjects.empty()) return;
    const ConfigNode base = cases.subjects.front().node;
    const ConfigNode* given = base.find(parameter.key);
    for (const std::string& value : parameter.choices) {
      if (value == (given != nullptr ? given->text() : parameter.default_value)) continue;
      ConfigNode varied = base;
      varied.take("type");
      varied.set(parameter.key, ConfigNode::scalar(value, where_), where_);
      add(to_flow_yaml(varied), cases.left_out);
    }
  }

  Cases cases;

 private:
  void add(ConfigNode node) {
    std::string settings = to_flow_yaml(node);
    const auto same = [&](const Subject& s) { return s.settings == settings; };
    if (std::any_of(cases.subjects.begin(), cases.subjects.end(), same)) return;
    if (node.is_mapping()) node.set("type", ConfigNode::scalar(plugin_.name, where_), where_);
    BuildContext context{registry_};
    ConfigNode resolved = ConfigNode::mapping();
    std::shared_ptr<const Component> component = plugin_.build(node, context, resolved);
    cases.subjects.push_back(
        {&plugin_, std::move(settings), std::move(node), std::move(component)});
  }

  /// Removes the folder's name from a message, because it differs from run to run.
  std::string without_folder(std::string message) const {
    const std::string prefix = fs::path(where_.file).parent_path().string() + "/";
    for (std::size_t at; (at = message.find(prefix)) != std::string::npos;) {
      message.erase(at, prefix.size());
    }
    return message;
  }

  const Registry& registry_;
  const PluginInfo& plugin_;
  Location where_;
};

}  // namespace

ExampleFolder::ExampleFolder() {
  std::string pattern = (fs::temp_directory_path() / "pharos-conformance-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw RunError("no temporary folder can be made");
  path_ = fs::canonical(pattern);
  write_exr(example_sky(), path_ / "example.exr");
  write_png(example_picture(), path_ / "example.png", 0, false);
  std::ofstream(path_ / "example.ply") << kExamplePly;
  std::ofstream(path_ / "example.txt") << kExamplePoints;
}

ExampleFolder::~ExampleFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

Cases cases_of(const Registry& registry, const PluginInfo& plugin, const fs::path& folder) {
  CaseBuilder builder(registry, plugin, folder);
  builder.add("{}", builder.cases.left_out);
  for (const std::string& example : plugin.examples) builder.add(example, builder.cases.broken);
  for (const ParameterInfo& parameter : plugin.parameters) builder.vary(parameter);
  return std::move(builder.cases);
}

std::vector<Subject> first_cases(const Registry& registry, std::string_view contract,
                                 const fs::path& folder) {
  std::vector<Subject> all;
  for (const std::string& name : registry.names(contract)) {
    Cases cases = cases_of(registry, *registry.find(contract, name), folder);
    if (!cases.subjects.empty()) all.push_back(std::move(cases.subjects.front()));
  }
  return all;
}

}  // namespace pharos::conformance
