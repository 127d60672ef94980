// What is read from a Markdown page.

#include "markdown.h"

#include <string>
#include <vector>

#include <doctest/doctest.h>

namespace pharos::docs {
namespace {

std::vector<std::string> targets(const std::string& text) {
  std::vector<std::string> all;
  for (const Link& link : parse_page(text).links) all.push_back(link.target);
  return all;
}

TEST_CASE("fenced blocks: language, text, place, paragraph before") {
  const Page page = parse_page(
      "# Title\n\nFirst.\n\nSave this\nas a file:\n\n```yaml title=\"a\"\na: 1\n\nb: 2\n```\n"
      "- item\n\n  ```\n  ./run test\n    more\n  ```\n~~~sh\n```\n~~~\n");
  REQUIRE(page.fences.size() == 3);
  CHECK(page.fences[0].language == "yaml");
  CHECK(page.fences[0].text == "a: 1\n\nb: 2\n");
  CHECK(page.fences[0].line == 8);
  CHECK(page.fences[0].before == "Save this as a file: ");
  CHECK(page.fences[1].language.empty());
  CHECK(page.fences[1].text == "./run test\n  more\n");
  CHECK(page.fences[2].language == "sh");
  CHECK(page.fences[2].text == "```\n");
  CHECK(page.open_fence == 0);
}

TEST_CASE("fenced blocks: longer marks contain shorter ones; the end may be missing") {
  const Page page = parse_page("````\n```yaml\na: 1\n```\n````\ntext\n\n```yaml\nb: 2\n");
  REQUIRE(page.fences.size() == 2);
  CHECK(page.fences[0].text == "```yaml\na: 1\n```\n");
  CHECK(page.fences[1].text == "b: 2\n");
  CHECK(page.open_fence == 8);
}

TEST_CASE("links and images, but none in code") {
  CHECK(targets("[a](b.md) and ![c](d/e.jpg \"title\")\n[long\ntext](f.md#g)") ==
        std::vector<std::string>{"b.md", "d/e.jpg", "f.md#g"});
  CHECK(targets("[`code`](a.md), `[b](c)`, ``[`](c)``\n\n```\n[d](e)\n```\n") ==
        std::vector<std::string>{"a.md"});
  CHECK(targets("[ref]: a.md\n<img width=\"1\" src=\"b.png\">") ==
        std::vector<std::string>{"a.md", "b.png"});
  CHECK(targets("one ` mark alone\n\n[a](b) and ` another") == std::vector<std::string>{"b"});
  const Page page = parse_page("text\n\n[a](b)\n");
  REQUIRE(page.links.size() == 1);
  CHECK(page.links[0].line == 3);
}

TEST_CASE("anchors of headings, as MkDocs makes them") {
  CHECK(slug("The functions of a pair") == "the-functions-of-a-pair");
  CHECK(slug("What is measured, and when?") == "what-is-measured-and-when");
  CHECK(slug("`path_record.h` (C++)") == "path_recordh-c");
  CHECK(slug("Sobol' \u2014 a sequence") == "sobol-a-sequence");
  CHECK(slug("--replay") == "-replay");
  CHECK(parse_page("# A [link](b.md) ##\n## Same\n## Same\n```\n# code\n```\n#none\n").anchors ==
        std::vector<std::string>{"a-link", "same", "same_1"});
}

}  // namespace
}  // namespace pharos::docs
