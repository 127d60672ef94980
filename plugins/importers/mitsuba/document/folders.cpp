#include "folders.h"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include <pharos/core/error.h>

namespace pharos::mitsuba {

std::vector<std::filesystem::path> Folders::places(const Element& element,
                                                   const std::filesystem::path& name) const {
  std::vector<std::filesystem::path> all{element.file().path().parent_path() / name};
  for (const std::filesystem::path& folder : resources_) all.push_back(folder / name);
  all.push_back(outermost_ / name);
  return all;
}

void Folders::add(const Element& element) {
  element.expect({"value"});
  const std::string& name = element.text("value");
  const auto all = places(element, name);
  const auto found = std::find_if(all.begin(), all.end(), [](const auto& place) {
    std::error_code failed;
    return std::filesystem::is_directory(place, failed);
  });
  if (name.empty() || found == all.end()) {
    element.fail("value", fmt::format("there is no folder '{}'{}", one_line(name, 200),
                                      file_suggestion(all.front())));
  }
  resources_.insert(resources_.begin(), *found);
}

std::filesystem::path Folders::file(const Element& element, std::string_view attribute) const {
  const std::string& name = element.text(attribute);
  if (name.empty()) element.fail(attribute, "expected the name of a file");
  const auto all = places(element, name);
  for (const std::filesystem::path& place : all) {
    if (file_problem(place).empty()) return place;
  }
  element.fail(attribute, fmt::format("'{}' cannot be read: {}", one_line(name, 200),
                                      file_problem(all.front())));
}

}  // namespace pharos::mitsuba
