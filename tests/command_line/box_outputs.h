#pragma once

#include <string>
#include <vector>

#include <pharos/core/image.h>

#include "process.h"

namespace pharos::testing {

/// The files that a render of box.yaml writes: the image box.exr and the model box.model.
struct BoxOutputs {
  std::vector<float> pixels;
  std::string model;
  bool operator==(const BoxOutputs&) const = default;
};

inline BoxOutputs box_outputs_in(const ScratchFolder& folder) {
  return {read_image(folder.path() / "box.exr").values(),
          test::bytes_of(folder.path() / "box.model")};
}

}  // namespace pharos::testing
