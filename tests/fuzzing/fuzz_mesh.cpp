// The first byte chooses a format, and the other bytes are a mesh file in this format. Wrong input
// may only end in an InputError.
//
// No path leads out of the folder of the file: if a format can name other files, characters that a
// path needs are replaced.

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include <pharos/config/module_loader.h>
#include <pharos/scene/shape.h>
#include <pharos/tests/fixtures.h>

namespace {

using namespace pharos;

constexpr std::array<std::string_view, 6> kFormats{"ply",  "obj", "stl",
                                                   "gltf", "glb", "serialized"};

/// Returns whether an OBJ line names no file. Faces, lines and points may need slashes, but they
/// name no files.
bool names_no_file(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t");
  return first == std::string_view::npos || line[first] == 'f' || line[first] == 'l' ||
         line[first] == 'p';
}

std::string keep_in_folder(std::string_view format, std::string_view bytes) {
  if (format == "ply" || format == "stl" || format == "serialized") return std::string(bytes);
  std::string kept(bytes);
  for (std::size_t begin = 0, end = 0; begin < kept.size(); begin = end + 1) {
    end = std::min(kept.find('\n', begin), kept.size());
    const bool harmless =
        format == "obj" && names_no_file(std::string_view(kept).substr(begin, end - begin));
    for (std::size_t i = begin; i < end; ++i) {
      if (kept[i] == '\\' || (kept[i] == '/' && !harmless)) kept[i] = '_';
    }
  }
  return kept;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Registry registry = load_default_modules();
  static const test::TemporaryFolder folder;
  if (size == 0) return -1;
  const std::string_view format = kFormats[data[0] % kFormats.size()];
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const auto file = folder.write("fuzz." + std::string(format), keep_in_folder(format, bytes));
  ConfigNode mesh = ConfigNode::mapping();
  mesh.set("type", ConfigNode::scalar("mesh"));
  mesh.set("file", ConfigNode::scalar(file.string()));
  mesh.set("normals", ConfigNode::scalar("file_or_smooth"));
  BuildContext context{registry};
  ConfigNode resolved;
  try {
    registry.build<Shape>(mesh, context, resolved);
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
  }
  return 0;
}
