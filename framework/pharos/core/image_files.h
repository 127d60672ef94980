#pragma once

#include <cstddef>
#include <filesystem>

#include <pharos/core/color_image.h>
#include <pharos/core/image.h>

namespace pharos {

// Limits of the image files that are read, besides kMostPixels.
inline constexpr int kLargestEdge = 65536;
/// More than any image format of textures and renders needs.
inline constexpr int kMostChannels = 1024;
/// Values of all channels together, 4 GiB as floats.
inline constexpr std::size_t kMostValues = std::size_t{1} << 30;

/// The functions behind image.h that read and write image files by OpenImageIO: all files except
/// the OpenEXR files of Pharos (exr_file.h). They live in a library of their own, libpharos_images,
/// which is loaded at the first such file. OpenImageIO depends on some 250 libraries, and loading
/// these takes longer than loading a small scene.
struct ImageFiles {
  Image (*read)(const std::filesystem::path& path, ColorSpace integer_formats);
  ColorImage (*read_colors)(const std::filesystem::path& path, ColorSpace integer_formats);
  Metadata (*read_metadata)(const std::filesystem::path& path);
  void (*write_png)(const Image& image, const std::filesystem::path& path, float exposure,
                    bool filmic);
};

/// Returns the functions; loads the library at the first call. Throws RunError if that fails.
const ImageFiles& image_files();

}  // namespace pharos

/// The entry point of libpharos_images.
extern "C" const pharos::ImageFiles* pharos_image_files();
