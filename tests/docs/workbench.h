#pragma once

#include <filesystem>
#include <string>

#include <pharos/config/registry.h>

#include "process.h"

namespace pharos::docs {

/// The source tree that the pages belong to.
std::filesystem::path source_tree();

/// All plugins of the build, and the integrands of `pharos convergence`.
const Registry& all_plugins();

/// A folder in which the blocks and commands of one page are tried. It has a copy of the
/// repository's configs and its scenes at the places that they have in the repository.
class Workbench {
 public:
  Workbench();

  const std::filesystem::path& path() const { return folder_.path(); }
  /// Writes a file and returns its path.
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    return folder_.write(name, text);
  }
  /// Whether there is such a file, here or in the repository.
  bool has(const std::string& name) const;
  /// Runs `pharos ARGUMENTS` here, with the stand-ins of the contract tests among its plugins.
  testing::Outcome run(const std::string& arguments) const;

 private:
  testing::ScratchFolder folder_;
};

}  // namespace pharos::docs
