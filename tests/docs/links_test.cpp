// Links of made-up pages.

#include "links.h"

#include <filesystem>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <pharos/tests/fixtures.h>

namespace pharos::docs {
namespace {

namespace fs = std::filesystem;

/// A source tree with pages that link to each other.
struct Tree {
  Tree() {
    fs::create_directories(folder / "docs/methods");
    fs::create_directories(folder / "docs/images");
    fs::create_directories(folder / "modules/one");
    folder.write("docs/images/a.png", "");
    folder.write("docs/other.md", "# Other\n## A part, of it\n");
    folder.write("modules/one/README.md", "# One\n");
    fs::create_symlink("../../modules/one/README.md", folder / "docs/methods/one.md");
  }

  std::vector<std::string> dead(const std::string& text) const {
    folder.write("docs/page.md", text);
    return dead_links(read_source_pages(folder.path()));
  }

  test::TemporaryFolder folder;
};

TEST_CASE("links: files, folders, anchors, other hosts") {
  const Tree tree;
  CHECK(tree.dead("# Here\n[a](other.md) [b](other.md#a-part-of-it) [c](#here) [d](images)\n"
                  "![e](images/a.png) [f](methods/one.md#one) [g](../modules/one/README.md)\n"
                  "[h](https://nowhere.invalid/x#y) [i](mailto:a@b.invalid)\n")
            .empty());
}

TEST_CASE("links: what is not there is found") {
  const Tree tree;
  CHECK(tree.dead("[a](gone.md)\n\n![b](images/gone.png)") ==
        std::vector<std::string>{"docs/page.md:1: link 'gone.md': there is no such file",
                                 "docs/page.md:3: link 'images/gone.png': there is no such file"});
  CHECK(tree.dead("[a](other.md#gone)") ==
        std::vector<std::string>{
            "docs/page.md:1: link 'other.md#gone': docs/other.md has no such heading"});
  CHECK(tree.dead("# Here\n[a](#there)").size() == 1);
  CHECK(tree.dead("[a](/docs/other.md)").size() == 1);
}

TEST_CASE("links hold at every place of a page") {
  const Tree tree;
  tree.folder.write("modules/one/README.md", "[a](plan.md)");
  tree.folder.write("modules/one/plan.md", "# Plan\n");
  CHECK(tree.dead("") ==
        std::vector<std::string>{"docs/methods/one.md:1: link 'plan.md': there is no such file"});
}

TEST_CASE("pages: each file once, and not the page that is generated") {
  const Tree tree;
  fs::create_directories(tree.folder / "docs/reference");
  tree.folder.write(kPluginReference, "[a](gone.md)");
  SourcePages pages = read_source_pages(tree.folder.path());
  REQUIRE(pages.pages.size() == 2);
  CHECK(pages.pages[0].file == "docs/other.md");
  CHECK(pages.pages[1].places.size() == 2);
  CHECK(pages.find("docs/methods/one.md") == pages.find("modules/one/README.md"));
  CHECK(pages.find(kPluginReference) == nullptr);
  add_page(pages, kPluginReference, "[a](gone.md)");
  CHECK(dead_links(pages).size() == 1);
}

}  // namespace
}  // namespace pharos::docs
