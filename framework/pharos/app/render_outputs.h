#pragma once

#include <pharos/rendering/render_config.h>

namespace pharos {

/// Checks that the files that a render writes can be written, and that none of them is an input or
/// another output. Throws InputError.
void check_outputs(const LoadedConfig& loaded);

/// Holds the disk space of an image while it renders, in a file without a name that vanishes with
/// the process.
class OutputSpace {
 public:
  /// Throws RunError if there is too little space.
  explicit OutputSpace(const RenderConfig& config);
  ~OutputSpace();
  OutputSpace(const OutputSpace&) = delete;
  OutputSpace& operator=(const OutputSpace&) = delete;

  /// Makes the space free for the image.
  void release();

 private:
  int file_ = -1;
};

}  // namespace pharos
