#pragma once

#include <cstddef>

#include <pharos/core/image.h>

#include "direction_field.h"

namespace pharos::aligned {

/// Draws the directions of a dimension in each region as segments through the region's center
/// (figure 7 of the paper). The background is `render`, an image of the field's film, darkened and
/// enlarged `scale` times. A segment's angle is the angle of the direction in the plane of the two
/// numbers, with the first number to the right and the second number upward. The color
/// distinguishes the first direction from the second. The channels are R, G, B, linear.
Image direction_picture(const Image& render, const DirectionField& field, std::size_t dimension,
                        int scale);

}  // namespace pharos::aligned
