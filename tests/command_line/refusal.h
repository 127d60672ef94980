#pragma once

#include <functional>
#include <string>
#include <vector>

#include "process.h"

namespace pharos::testing {

/// A wrong use of the program: the command line, and the preparation of the folder in which it
/// runs.
struct Mistake {
  std::string arguments;
  std::function<void(const ScratchFolder&)> prepare = {};
  std::string environment = {};
};

/// Runs `mistake` and checks that it ends as bad input must: with one line for each flaw on
/// standard error, which contains all texts of `says`, with exit code 2, quickly, with little
/// memory, and without writing or changing a file.
void check_refused(const Mistake& mistake, const std::vector<std::string>& says);

/// Checks the same for `render bad.yaml` with this text.
void check_refused(const std::string& config, const std::vector<std::string>& says);

/// Checks the same for a config whose shape is the mesh in file `name` with this text. The message
/// must name the file and `place`, which is "line:column" in the file. If `place` is empty, the
/// message must name the place where the config names the file.
void check_mesh_refused(const std::string& name, const std::string& text,
                        const std::string& place = "");

/// Returns a valid config of four lines, with `more` from line 5 on.
std::string config_with(const std::string& more);

/// Returns a config with one shape, which is in line 4 from column 7 on.
std::string config_with_shape(const std::string& shape);

}  // namespace pharos::testing
