#pragma once

#include <functional>
#include <string>
#include <vector>

#include "process.h"

namespace pharos::testing {

/// A wrong use of the program: what is typed, in a folder made ready for it.
struct Mistake {
  std::string arguments;
  std::function<void(const ScratchFolder&)> prepare = {};
  std::string environment = {};
};

/// Runs `mistake` and checks that it ends as bad input must: in one line on standard error that
/// holds all of `says`, exit code 2, soon, without much memory, and with no file written or
/// changed.
void check_refused(const Mistake& mistake, const std::vector<std::string>& says);

/// The same for `render bad.yaml` with this text.
void check_refused(const std::string& config, const std::vector<std::string>& says);

/// The same for a config whose shape is the mesh in file `name` with this text: the message must
/// name the file, and stand at `place`, "line:column" of the file, or where the config names it.
void check_mesh_refused(const std::string& name, const std::string& text,
                        const std::string& place = "");

/// A config of four lines that is fine, with `more` from line 5 on.
std::string config_with(const std::string& more);

/// A config with one shape, which stands in line 4 from column 7 on.
std::string config_with_shape(const std::string& shape);

}  // namespace pharos::testing
