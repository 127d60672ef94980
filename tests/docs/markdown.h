#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// What the tests of the documentation need to know of a Markdown page.
namespace pharos::docs {

/// A fenced block.
struct Fence {
  std::string language;  ///< first word behind the opening marks; may be empty
  std::string text;      ///< lines without the indentation of the opening marks
  std::size_t line = 0;  ///< line of the opening marks
  std::string before;    ///< the paragraph before the block
};

/// A link or an image.
struct Link {
  std::string target;
  std::size_t line = 0;
};

struct Page {
  std::vector<Fence> fences;
  std::vector<Link> links;           ///< those outside of code
  std::vector<std::string> anchors;  ///< of all headings, as MkDocs makes them
  std::size_t open_fence = 0;        ///< line of a block that does not end; 0: there is none
};

/// Reads fenced blocks, headings, inline links, link definitions and HTML attributes `src` and
/// `href`.
Page parse_page(std::string_view text);

/// Returns the anchor that MkDocs makes for a heading: lower case, spaces become hyphens,
/// punctuation and letters outside ASCII are dropped.
std::string slug(std::string_view heading);

}  // namespace pharos::docs
