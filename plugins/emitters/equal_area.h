#pragma once

#include <filesystem>

#include <pharos/core/vec.h>

#include "latlong_image.h"

/// The equal-area map between the sphere and the square by Clarberg 2008, "Fast Equal-Area Mapping
/// of the (Hemi)Sphere using SIMD", as pbrt-v4 uses it for environment images.
namespace pharos {

/// Returns the point of the unit square for a unit direction. +z is the middle of the square, -z
/// its corners.
Vec2 equal_area_square(Vec3 direction);

/// Reads a square image in this layout, whose first row is at y = 0 of the square, and returns its
/// colors in latitude-longitude layout, with as many rows. Throws InputError as LatLongImage does,
/// and for images that are not square.
LatLongImage read_equal_area(const std::filesystem::path& file);

}  // namespace pharos
