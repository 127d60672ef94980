#pragma once

#include <string>

#include <pharos/guiding/record/path_record.h>

namespace pharos {

/// Returns a readable description of a recorded path: lines for each vertex, its emission, its
/// light samples and its step.
std::string path_text(const PathView& path, Rgb radiance);

}  // namespace pharos
