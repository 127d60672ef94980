// Tests of the report page as a file: its content, and that nothing in it breaks out of its element
// or loads anything.

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <pharos/core/error.h>
#include <pharos/experiments/report/page_data.h>
#include <pharos/experiments/report/report.h>

#include "../../tests/fixtures.h"
#include "../../tests/small_files.h"
#include "sample_report.h"

namespace pharos {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string content(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::string written(const Report& report) {
  const test::TemporaryFolder folder;
  write_report(report, folder / "report.html");
  CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 1);
  return content(folder / "report.html");
}

/// Returns the text between the first `open` and the next `close` after it.
std::string between(const std::string& text, const std::string& open, const std::string& close) {
  const std::size_t begin = text.find(open);
  REQUIRE(begin != std::string::npos);
  const std::size_t end = text.find(close, begin + open.size());
  REQUIRE(end != std::string::npos);
  return text.substr(begin + open.size(), end - begin - open.size());
}

/// Returns the data as a browser finds it: up to the first end tag.
json data_of(const std::string& page) {
  return json::parse(between(page, "id=\"report-data\">", "</script"));
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

TEST_CASE("texts come back as they were, whatever they hold") {
  const std::string nasty =
      "</script><!-- <b> & \" ' \\ \n\t\r\x01\x1f\x7f \xe2\x80\xa8 \xf0\x9f\x94\xad </SCRIPT >" +
      std::string(1, '\0') + "@data@ @title@ end";
  Report report;
  report.title = report.description = nasty;
  report.methods = {nasty};
  report.facts = {{nasty, nasty}};
  report.texts = {{nasty, nasty}};
  report.scenes = {{.name = nasty, .note = nasty, .images = {}, .pictures = {}}};
  const std::string page = written(report);
  const json data = data_of(page);
  CHECK(data["title"] == nasty);
  CHECK(data["description"] == nasty);
  CHECK(data["methods"][0] == nasty);
  CHECK(data["facts"][0][1] == nasty);
  CHECK(data["texts"][0]["text"] == nasty);
  CHECK(data["scenes"][0]["note"] == nasty);
  // The page has the same elements as one without any text.
  const std::string plain = written({});
  for (const char* tag : {"<script", "</script", "<!--", "<b>"}) {
    CAPTURE(tag);
    CHECK(count(page, tag) == count(plain, tag));
  }
  CHECK(between(page, "<title>", "</title>").find_first_of("<>\"\n") == std::string::npos);
}

TEST_CASE("the title is HTML") {
  CHECK(html_text("a <b> & \"c\"\n\x01 \xc3\xa9") == "a &lt;b&gt; &amp; &quot;c&quot; ? \xc3\xa9");
}

TEST_CASE("what is no UTF-8 becomes U+FFFD") {
  CHECK(html_text("caf\xe9!") == "caf\xef\xbf\xbd!");
  Report report;
  report.title = "caf\xe9!";
  CHECK(data_of(written(report))["title"] == "caf\xef\xbf\xbd!");
}

TEST_CASE("numbers that JSON lacks") {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Report report;
  report.methods = {"a", "b"};
  report.tables = {{.key = "mse", .title = "MSE", .unit = "", .definition = "", .rows = {}}};
  report.tables[0].rows = {
      {"scene", {{}, {.value = 0.1, .interval = Interval{-kInfinity, kInfinity}}}}};
  const json cells = data_of(written(report))["tables"][0]["rows"][0]["cells"];
  CHECK(cells[0]["value"].is_null());
  CHECK(cells[0]["interval"].is_null());
  CHECK(cells[1]["value"] == 0.1);
  CHECK(cells[1]["interval"] == json{"-Infinity", "Infinity"});
}

TEST_CASE("every image of the data is in the page") {
  const std::string page = written(test::sample_report());
  const json data = data_of(page);
  std::size_t images = 0;
  const auto check = [&](const json& index) {
    CHECK(index == images++);
    CHECK(count(page, "id=\"image-" + std::to_string(index.get<int>()) + "\"") == 1);
  };
  for (const json& scene : data["scenes"]) {
    for (const json& image : scene["images"]) {
      check(image["image"]);
      for (const json& map : image["error_maps"]) check(map["image"]);
    }
    for (const json& picture : scene["pictures"]) check(picture["image"]);
  }
  CHECK(images == 16);
}

TEST_CASE("the page forbids itself to load anything, and names nothing to load") {
  const std::string page = written(test::sample_report());
  CHECK(page.find("content=\"default-src 'none'; script-src 'unsafe-inline'; "
                  "style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'\"") !=
        std::string::npos);
  for (const char* way : {" src=", "href=\"", "@import", "url(", "XMLHttpRequest", "WebSocket(",
                          "sendBeacon", "EventSource", "fetch(", "import("}) {
    CAPTURE(way);
    // The sample's description contains markup. It is data, so it is escaped.
    CHECK(count(page, way) == (std::string(way) == " src=" ? 1 : 0));
  }
  // The notices of the chart library contain the addresses of its origin.
  std::size_t addresses = count(page, "http://") + count(page, "https://");
  for (const char* notice :
       {"https://www.chartjs.org\n", "https://github.com/kurkle/color#readme\n"}) {
    addresses -= count(page, notice);
  }
  CHECK(addresses == 0);
}

TEST_CASE("the chart library comes with its license") {
  const std::string page = written({});
  CHECK(page.find("Chart.js Contributors") != std::string::npos);
  CHECK(page.find("Permission is hereby granted") != std::string::npos);
}

TEST_CASE("a report that does not fit together is refused") {
  const auto refused = [](const char* part, auto&& change) {
    Report report = test::sample_report();
    change(report);
    const test::TemporaryFolder folder;
    CHECK_THROWS_WITH_AS(write_report(report, folder / "report.html"), doctest::Contains(part),
                         InputError);
    CHECK(fs::is_empty(folder.path()));
  };
  refused("'none such' is none of the methods", [](Report& r) { r.baseline = "none such"; });
  refused("has 2 cells", [](Report& r) { r.tables[0].rows[0].cells.pop_back(); });
  refused("belongs to no method", [](Report& r) { r.curves[0].method = "none such"; });
  refused("the axis 'hours'", [](Report& r) { r.curves[0].axis = "hours"; });
  refused("no table's key", [](Report& r) { r.curves[0].metric = "none such"; });
  refused("another size",
          [](Report& r) { r.scenes[0].images[1].image = r.scenes[1].images[0].image; });
  refused("another size",
          [](Report& r) { r.scenes[0].images[1].error_maps[0].map = Image(3, 3, {"Y"}); });
  refused("has no pixels", [](Report& r) { r.scenes[0].pictures[0].image = {}; });
  refused("no channel 'B'", [](Report& r) {
    r.scenes[0].images[0].image = Image(320, 200, {"R", "G"});
  });
}

TEST_CASE("the file appears whole or not at all") {
  const test::TemporaryFolder folder;
  const fs::path path = folder / "report.html";
  std::ofstream(path) << "before";
  Report broken = test::sample_report();
  // This error is detected only after most of the page has been written.
  broken.scenes.back().images.back().image = Image(64, 32, {"Y"});
  CHECK_THROWS_AS(write_report(broken, path), InputError);
  CHECK(content(path) == "before");
  write_report({}, path);
  CHECK(content(path).ends_with("</html>\n"));
  CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 1);
  CHECK_THROWS_WITH_AS(write_report({}, folder / "none" / "report.html"),
                       doctest::Contains("there is no folder"), RunError);
}

TEST_CASE("a disk that is full leaves the older file") {
  const test::TemporaryFolder folder;
  const fs::path path = folder / "report.html";
  std::ofstream(path) << "before";
  {
    const test::SmallFiles limit;
    CHECK_THROWS_AS(write_report(test::sample_report(), path), RunError);
  }
  CHECK(content(path) == "before");
  CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 1);
}

}  // namespace
}  // namespace pharos
