#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "markdown.h"

namespace pharos::docs {

/// The folders of the root that hold sources, not products of a build.
inline constexpr auto kSourceFolders = std::to_array<std::string_view>(
    {"configs", "docs", "framework", "modules", "plugins", "scenes", "tests"});

/// A Markdown file. Links on it must hold at each of its places.
struct SourcePage {
  std::filesystem::path file;                 ///< relative to the root
  std::vector<std::filesystem::path> places;  ///< the file and the symbolic links to it
  Page page;
};

/// The pages of a source tree.
struct SourcePages {
  std::filesystem::path root;
  std::vector<SourcePage> pages;  ///< ordered by `file`

  /// Returns the page that is at a path relative to the root, and null if there is none.
  const SourcePage* find(const std::filesystem::path& place) const;
};

/// Reads the Markdown files in `root` and in its folders of sources. Each file is one page, however
/// many symbolic links lead to it. Leaves out docs/reference/plugins.md, which `./run docs` writes:
/// it may be out of date.
SourcePages read_source_pages(const std::filesystem::path& root);

/// Adds a page that is not a file of the source tree.
void add_page(SourcePages& pages, const std::filesystem::path& file, const std::string& text);

/// The page that `./run docs` writes.
inline constexpr const char* kPluginReference = "docs/reference/plugins.md";

}  // namespace pharos::docs
