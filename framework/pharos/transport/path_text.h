#pragma once

#include <string>

#include <pharos/guiding/record/path_record.h>

namespace pharos {

/// Describes a recorded path for people: one line for each vertex and one for each light sample.
std::string path_text(const PathView& path, Rgb radiance);

}  // namespace pharos
