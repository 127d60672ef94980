// The bytes are a config that contains its scene. The fuzzer parses the config, builds every
// component and prepares the scene for rendering. Wrong input may only end in an InputError. If a
// config is accepted, the text of its resolved config must read back as the same config.
//
// No path leads out of a folder of fixtures, because everything up to the last slash of a file name
// is removed.

#include <cstdint>
#include <cstdlib>
#include <exception>

#include <fmt/format.h>

#include <pharos/config/module_loader.h>
#include <pharos/core/image.h>
#include <pharos/rendering/render_config.h>
#include <pharos/tests/fixtures.h>

namespace {

using namespace pharos;

/// The files to which configs may refer: one valid file of each kind.
const test::TemporaryFolder& fixtures() {
  static const test::TemporaryFolder folder;
  static const bool filled = [] {
    folder.write("example.ply",
                 "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                 "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                 "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    folder.write("base.yaml", "film: { width: 16, height: 16 }\nbudget: { spp: 1 }\n");
    folder.write("scene.yaml", "sensor: perspective\nshapes: [sphere, { type: quad }]\n");
    Image image(4, 2, {"R", "G", "B"});
    for (float& value : image.values()) value = 0.5f;
    write_exr(image, folder / "example.exr");
    write_png(image, folder / "example.png");
    return true;
  }();
  static_cast<void>(filled);
  return folder;
}

void keep_in_folder(ConfigNode& node) {
  if (node.is_scalar()) {
    const std::size_t slash = node.text().rfind('/');
    if (slash != std::string::npos) {
      node = ConfigNode::scalar(node.text().substr(slash + 1), node.where());
    }
  }
  for (ConfigNode& item : node.items()) keep_in_folder(item);
  for (ConfigNode::Entry& entry : node.entries()) keep_in_folder(entry.value);
}

/// Does everything that comes before the first sample.
void prepare(const RenderConfig& config) {
  constexpr int edge = 16;  // the film's own size would only cost time
  SceneParts parts = config.scene;
  if (config.sensor != nullptr) parts.sensor = config.sensor;
  const Scene scene(parts);
  const auto sensor = scene.sensor().prepare(edge, edge);
  config.integrator->prepare({scene, *sensor, edge, edge});
}

void check_round_trip(const LoadedConfig& loaded, const Registry& registry) {
  const std::string text = to_yaml(loaded.resolved);
  try {
    const LoadedConfig again = build_render_config(parse_yaml(text, "resolved.yaml"), registry);
    if (to_yaml(again.resolved) == text) return;
    fmt::print(stderr, "another text of all values in force:\n{}\n{}\n", text,
               to_yaml(again.resolved));
  } catch (const InputError& error) {
    fmt::print(stderr, "the values in force are refused: {}\n{}\n", error.what(), text);
  }
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Registry registry = load_default_modules();
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    ConfigNode config = parse_yaml(text, "fuzz.yaml");
    keep_in_folder(config);
    fixtures().write("fuzz.yaml", to_yaml(config));
    const LoadedConfig loaded = load_render_config(fixtures() / "fuzz.yaml", {}, registry);
    check_round_trip(loaded, registry);
    prepare(loaded.config);
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
  }
  return 0;
}
