#pragma once

#include <filesystem>
#include <optional>

#include <pharos/core/color_image.h>
#include <pharos/core/image.h>

namespace pharos {

// OpenEXR files that write_exr() wrote, read by OpenEXR alone: it is loaded a hundred times as fast
// as OpenImageIO. Such a file has the attribute `pharos:channels`, which lists its channels in the
// order of the image. The functions return nothing for all other files, and for those that are
// damaged, changed to another kind of EXR file, or too large. OpenImageIO then reads the file or
// says what is wrong with it (image_files.h).

/// See read_image(). The channels have the order of the image that was written.
std::optional<Image> read_own_exr(const std::filesystem::path& path);

/// See read_colors().
std::optional<ColorImage> read_own_exr_colors(const std::filesystem::path& path);

/// See read_metadata(). Returns the entries that were given to write_exr(), and no others.
std::optional<Metadata> read_own_exr_metadata(const std::filesystem::path& path);

}  // namespace pharos
