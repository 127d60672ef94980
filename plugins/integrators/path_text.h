#pragma once

#include <string>

#include <pharos/guiding/record/path_record.h>

namespace pharos {

/// A recorded path as a table for people: one line a vertex, one a light sample.
std::string path_text(const PathView& path, Rgb radiance);

}  // namespace pharos
