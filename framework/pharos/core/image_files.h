#pragma once

#include <filesystem>

#include <pharos/core/color_image.h>
#include <pharos/core/image.h>

namespace pharos {

/// The functions behind image.h, which read and write image files by OpenImageIO. They live in a
/// library of their own, libpharos_images, which is loaded when the first image is read or written.
/// OpenImageIO depends on some 250 libraries, and loading these takes longer than loading a small
/// scene.
struct ImageFiles {
  Image (*read)(const std::filesystem::path& path, ColorSpace integer_formats);
  ColorImage (*read_colors)(const std::filesystem::path& path, ColorSpace integer_formats);
  Metadata (*read_metadata)(const std::filesystem::path& path);
  void (*write_exr)(const Image& image, const std::filesystem::path& path,
                    const Metadata& metadata);
  void (*write_png)(const Image& image, const std::filesystem::path& path, float exposure,
                    bool filmic);
};

}  // namespace pharos

/// The entry point of libpharos_images.
extern "C" const pharos::ImageFiles* pharos_image_files();
