#include "source_pages.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>

namespace pharos::docs {
namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

bool is_page(const fs::directory_entry& entry) {
  return entry.path().extension() == ".md" && entry.is_regular_file();
}

/// Returns the paths of all Markdown files and of symbolic links to such files, sorted.
std::vector<fs::path> paths_of_pages(const fs::path& root) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(root)) {
    if (is_page(entry)) paths.push_back(entry.path());
  }
  for (const std::string_view folder : kSourceFolders) {
    if (!fs::exists(root / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (is_page(entry)) paths.push_back(entry.path());
    }
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

}  // namespace

const SourcePage* SourcePages::find(const fs::path& place) const {
  for (const SourcePage& page : pages) {
    if (std::find(page.places.begin(), page.places.end(), place) != page.places.end()) return &page;
  }
  return nullptr;
}

SourcePages read_source_pages(const fs::path& root) {
  SourcePages result{.root = fs::canonical(root), .pages = {}};
  std::map<fs::path, std::vector<fs::path>> places;
  for (const fs::path& path : paths_of_pages(result.root)) {
    const fs::path place = path.lexically_relative(result.root);
    if (place != kPluginReference) places[fs::canonical(path)].push_back(place);
  }
  for (auto& [file, all] : places) {
    result.pages.push_back({.file = file.lexically_relative(result.root),
                            .places = std::move(all),
                            .page = parse_page(content_of(file))});
  }
  return result;
}

void add_page(SourcePages& pages, const fs::path& file, const std::string& text) {
  pages.pages.push_back({.file = file, .places = {file}, .page = parse_page(text)});
}

}  // namespace pharos::docs
