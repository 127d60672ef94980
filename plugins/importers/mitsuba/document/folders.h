#pragma once

#include <filesystem>
#include <vector>

#include "element.h"

namespace pharos::mitsuba {

/// The search path for the files that a scene names: beside the file that names them, in the
/// folders of `path` tags, and beside the outermost file.
class Folders {
 public:
  explicit Folders(std::filesystem::path outermost) : outermost_(std::move(outermost)) {}

  /// Adds the folder named by `value` of a `path` tag. Throws InputError if there is no such
  /// folder.
  void add(const Element& element);
  /// Returns the file that an attribute names. Throws InputError if the file cannot be read.
  std::filesystem::path file(const Element& element, std::string_view attribute) const;

  const std::filesystem::path& outermost() const { return outermost_; }
  /// Returns the folders of `path` tags, the last one first.
  const std::vector<std::filesystem::path>& resources() const { return resources_; }

 private:
  /// Returns all candidate places for this name, the nearest first.
  std::vector<std::filesystem::path> places(const Element& element,
                                            const std::filesystem::path& name) const;

  std::filesystem::path outermost_;
  std::vector<std::filesystem::path> resources_;
};

}  // namespace pharos::mitsuba
