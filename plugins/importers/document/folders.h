#pragma once

#include <filesystem>
#include <vector>

#include "element.h"

namespace pharos::mitsuba {

/// Where the files that a scene names are looked for: beside the file that names them, in the
/// folders of `path` tags, beside the outermost file.
class Folders {
 public:
  explicit Folders(std::filesystem::path outermost) : outermost_(std::move(outermost)) {}

  /// Takes a folder that a tag `path` names in `value`. Throws InputError when there is none.
  void add(const Element& element);
  /// The file that an attribute names. Throws InputError when it cannot be read.
  std::filesystem::path file(const Element& element, std::string_view attribute) const;

  const std::filesystem::path& outermost() const { return outermost_; }
  /// Those of `path` tags, the last one first.
  const std::vector<std::filesystem::path>& resources() const { return resources_; }

 private:
  /// Every place where something of this name may be, the nearest first.
  std::vector<std::filesystem::path> places(const Element& element,
                                            const std::filesystem::path& name) const;

  std::filesystem::path outermost_;
  std::vector<std::filesystem::path> resources_;
};

}  // namespace pharos::mitsuba
