// Rules for includes (docs/architecture.md): every folder may include only certain other folders.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <doctest/doctest.h>

namespace {

namespace fs = std::filesystem;

/// The framework's folders from bottom to top. Each folder may include itself and the folders
/// before it.
const std::vector<std::string> kLayers{"core",        "statistics", "config",      "scene",
                                       "sampling",    "guiding",    "rendering",   "transport",
                                       "experiments", "laboratory", "conformance", "app"};

std::size_t layer(const std::string& folder) {
  return static_cast<std::size_t>(std::find(kLayers.begin(), kLayers.end(), folder) -
                                  kLayers.begin());
}

struct Include {
  fs::path file;     ///< relative to the project's root
  std::string name;  ///< text between the brackets or quotes
};

/// Returns every #include in the sources below a folder, except the sources of out-of-tree
/// projects.
std::vector<Include> includes_below(const std::string& folder) {
  std::vector<Include> all;
  const fs::path root = PHAROS_SOURCE;
  for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
    const std::string extension = entry.path().extension();
    if (extension != ".h" && extension != ".cpp") continue;
    std::ifstream in(entry.path());
    for (std::string line; std::getline(in, line);) {
      if (line.rfind("#include ", 0) != 0) continue;
      const std::size_t begin = line.find_first_of("<\"") + 1;
      const std::size_t end = line.find_first_of(">\"", begin);
      all.push_back({fs::relative(entry.path(), root), line.substr(begin, end - begin)});
    }
  }
  return all;
}

bool starts_with(const std::string& text, const std::string& start) {
  return text.rfind(start, 0) == 0;
}

/// Whether an include that begins with ".." leads to a file in the same plugin or module folder.
bool stays_in_folder(const Include& include) {
  if (!starts_with(include.name, "..")) return true;
  const fs::path target = (include.file.parent_path() / include.name).lexically_normal();
  // "plugins/importers" or "modules/focal"
  return std::equal(include.file.begin(), std::next(include.file.begin(), 2), target.begin(),
                    std::next(target.begin(), std::min<std::ptrdiff_t>(
                                                  2, std::distance(target.begin(), target.end()))));
}

/// Returns the folder of an include, such as "scene" for <pharos/scene/shape.h>, and an empty
/// string for includes of other libraries.
std::string framework_folder(const std::string& include) {
  if (!starts_with(include, "pharos/")) return {};
  return include.substr(7, include.find('/', 7) - 7);
}

TEST_CASE("the framework's folders include only those below them") {
  std::size_t seen = 0;
  for (const Include& include : includes_below("framework")) {
    CAPTURE(include.file.string());
    CAPTURE(include.name);
    const std::string from = std::next(include.file.begin(), 2)->string();
    const std::string to = framework_folder(include.name);
    // Tests that lie beside what they test may use what all tests share.
    const bool is_test = include.file.parent_path().filename() == "tests";
    if (to.empty() || from == "tests" || (is_test && to == "tests")) continue;
    REQUIRE(layer(from) < kLayers.size());
    CHECK(layer(to) <= layer(from));
    ++seen;
  }
  CHECK(seen > 100);
}

TEST_CASE("includes that leave a folder are recognized") {
  const fs::path file = "plugins/importers/mitsuba/document/values.h";
  CHECK(stays_in_folder({file, "../../shared/numbers.h"}));
  CHECK(stays_in_folder({file, "element.h"}));
  CHECK_FALSE(stays_in_folder({file, "../../../shapes/mesh.h"}));
  CHECK_FALSE(stays_in_folder({file, "../../../../framework/pharos/core/error.h"}));
  CHECK_FALSE(stays_in_folder({"modules/focal/focal.h", "../aligned/sampler.h"}));
}

TEST_CASE(
    "plugins, modules and the Python package include the framework and their own folder only") {
  std::size_t seen = 0;
  for (const std::string group : {"plugins", "modules", "python"}) {
    for (const Include& include : includes_below(group)) {
      CAPTURE(include.file.string());
      CAPTURE(include.name);
      CHECK(framework_folder(include.name) != "app");
      CHECK(stays_in_folder(include));
      CHECK(include.name.find("plugins/") == std::string::npos);
      CHECK(include.name.find("modules/") == std::string::npos);
      ++seen;
    }
  }
  CHECK(seen > 100);
}

TEST_CASE("one file knows yaml-cpp, one knows Embree, one OpenEXR, one OpenImageIO, one MPI") {
  for (const Include& include : includes_below("framework")) {
    const std::string file = include.file.generic_string();
    if (starts_with(include.name, "yaml-cpp/")) CHECK(file == "framework/pharos/config/yaml.cpp");
    if (starts_with(include.name, "embree"))
      CHECK(file == "framework/pharos/scene/accelerator.cpp");
    if (starts_with(include.name, "OpenEXR/")) CHECK(file == "framework/pharos/core/exr_file.cpp");
    if (starts_with(include.name, "OpenImageIO/"))
      CHECK(file == "framework/pharos/core/image_files.cpp");
    if (include.name == "mpi.h") CHECK(file == "framework/pharos/rendering/mpi_ranks.cpp");
  }
}

/// The folders of modules.
std::vector<std::string> module_names() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(fs::path(PHAROS_SOURCE) / "modules")) {
    if (entry.is_directory()) names.push_back(entry.path().filename());
  }
  return names;
}

/// Whether a text names a module: its folder, namespace or plugin.
bool names_module(const std::string& text, const std::string& module) {
  // A usual word names the module only as a folder, as a namespace, or in backquotes.
  if (module == "aligned") {
    return text.find("modules/aligned") != std::string::npos ||
           text.find("pharos::aligned") != std::string::npos ||
           text.find("`aligned`") != std::string::npos;
  }
  return text.find(module) != std::string::npos;
}

TEST_CASE("names of modules are recognized") {
  CHECK(names_module("as in modules/aligned/README.md", "aligned"));
  CHECK_FALSE(names_module("an axis-aligned box", "aligned"));
  CHECK(names_module("the guiders of module spatial_gaussians", "spatial_gaussians"));
}

TEST_CASE("the framework names no module and no method") {
  std::vector<std::string> words = module_names();
  REQUIRE(words.size() >= 7);
  for (const char* method : {"triplet", "pavmm", "sd-tree", "vmf"}) words.emplace_back(method);
  for (const auto& entry :
       fs::recursive_directory_iterator(fs::path(PHAROS_SOURCE) / "framework")) {
    if (!entry.is_regular_file()) continue;
    std::ifstream in(entry.path());
    std::string text{std::istreambuf_iterator<char>(in), {}};
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    for (const std::string& word : words) {
      CAPTURE(entry.path().string());
      CAPTURE(word);
      CHECK_FALSE(names_module(text, word));
    }
  }
}

}  // namespace
