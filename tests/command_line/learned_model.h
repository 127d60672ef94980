#pragma once

#include <string>

#include "process.h"

namespace pharos::testing {

/// The environment that makes the program load the stand-ins, which it does not load by itself.
inline const std::string kStandIns = std::string("PHAROS_MODULE_PATH=") + PHAROS_TEST_PLUGINS;

/// A scene file with a closed box from (-2, -1, -1) to (2, 1, 1), a ball of radius 0.5 in its
/// center, and a camera in the box.
std::string box_scene();

/// A config for `box.yaml` that is guided by the stand-in `learner` and writes `box.model`.
std::string training_config(const std::string& learner);

/// Writes box.yaml, train.yaml and the box.model that stub_segments learns there into `folder`.
void write_learned_model(const ScratchFolder& folder);

}  // namespace pharos::testing
