#pragma once

#include <cstddef>

#include <pharos/core/image.h>

#include "direction_field.h"

namespace pharos::aligned {

/// `render`, an image of the field's film, darkened and `scale` times as large, with the directions
/// of a dimension in each region as segments through its middle (figure 7 of the paper): as angles
/// in the plane of the two numbers, the first to the right and the second upwards. The color tells
/// the first direction from the second. Channels R, G, B, linear.
Image direction_picture(const Image& render, const DirectionField& field, std::size_t dimension,
                        int scale);

}  // namespace pharos::aligned
