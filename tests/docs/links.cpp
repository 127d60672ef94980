#include "links.h"

#include <algorithm>
#include <regex>

#include <fmt/format.h>

namespace pharos::docs {
namespace {

namespace fs = std::filesystem;

bool leads_elsewhere(const std::string& target) {
  static const std::regex scheme(R"(([a-zA-Z][a-zA-Z0-9+.-]*:|//).*)");
  return std::regex_match(target, scheme);
}

/// Returns what is wrong with a link from a place of a page, and an empty string if nothing is.
std::string problem_of(const SourcePages& pages, const fs::path& place, const std::string& target) {
  const std::size_t hash = std::min(target.find('#'), target.size());
  const std::string path = target.substr(0, hash), anchor = target.substr(hash);
  if (path.starts_with('/')) return "the path is absolute";
  const fs::path file = path.empty() ? place : (place.parent_path() / path).lexically_normal();
  const SourcePage* page = pages.find(file);
  if (page == nullptr && !fs::exists(pages.root / file)) return "there is no such file";
  if (page == nullptr || anchor.size() <= 1) return {};
  const std::vector<std::string>& anchors = page->page.anchors;
  const bool found = std::find(anchors.begin(), anchors.end(), anchor.substr(1)) != anchors.end();
  return found ? "" : fmt::format("{} has no such heading", file.string());
}

}  // namespace

std::vector<std::string> dead_links(const SourcePages& pages) {
  std::vector<std::string> problems;
  for (const SourcePage& page : pages.pages) {
    for (const fs::path& place : page.places) {
      for (const Link& link : page.page.links) {
        if (leads_elsewhere(link.target)) continue;
        const std::string problem = problem_of(pages, place, link.target);
        if (problem.empty()) continue;
        problems.push_back(
            fmt::format("{}:{}: link '{}': {}", place.string(), link.line, link.target, problem));
      }
    }
  }
  return problems;
}

}  // namespace pharos::docs
