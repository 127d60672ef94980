#pragma once

#include <filesystem>

namespace pharos {

/// Returns whether each attribute in the headers of an OpenEXR file claims no more bytes than the
/// file has. The library allocates what an attribute claims before it reads it, up to 2 GiB.
/// Returns true for files of other formats and for files that cannot be read.
bool exr_header_fits(const std::filesystem::path& path);

}  // namespace pharos
