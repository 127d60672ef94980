#pragma once

#include <string>

#include "process.h"

namespace pharos::testing {

/// The stand-ins for methods, which the program does not load by itself.
inline const std::string kStandIns = std::string("PHAROS_MODULE_PATH=") + PHAROS_TEST_PLUGINS;

/// A closed box from (-2, -1, -1) to (2, 1, 1) with a ball of radius 0.5 in the middle, as a scene
/// file, and a camera in it.
std::string box_scene();

/// A config of `box.yaml` that the stand-in `learner` guides and that writes `box.model`.
std::string training_config(const std::string& learner);

/// Puts box.yaml, train.yaml and the box.model that stub_segments learns there into `folder`.
void write_learned_model(const ScratchFolder& folder);

}  // namespace pharos::testing
