#pragma once

#include <string>
#include <vector>

#include <pharos/config/node.h>

#include "markdown.h"
#include "workbench.h"

/// Blocks of YAML on pages, as configs of the program.
namespace pharos::docs {

/// How far a block could be checked.
enum class Depth {
  skipped,    ///< it leaves something out and is no YAML
  parsed,     ///< it is YAML, but leaves something out, or is one plugin without its place
  validated,  ///< it was read as the config of a render, an experiment or the laboratory
};

struct BlockCheck {
  Depth depth = Depth::validated;
  std::string problem;  ///< empty if nothing is wrong
};

/// Returns the config of a small render whose keys and values are replaced by those of `part`. Keys
/// of scenes, integrators and guides may be at the top of `part`.
ConfigNode render_with(ConfigNode part);

/// Checks a block as if it were a file in configs/, or an experiment in configs/experiments/.
BlockCheck check_block(const std::string& yaml, const Workbench& bench);

/// Saves the blocks that the page asks to save in configs/. The paragraph before such a block names
/// a file that is not part of the repository.
void save_named_blocks(const std::vector<Fence>& fences, const Workbench& bench);

}  // namespace pharos::docs
