#pragma once

/// The tables of the sky by Hosek and Wilkie 2012. Each number is a control point of a quintic
/// Bezier curve over the cube root of the sun's elevation, as a share of a right angle. The indices
/// are the channel (red, green, blue), the albedo of the ground (0 and 1), the turbidity (1 to 10),
/// and the control point.
namespace pharos::hosek_wilkie {

/// The parameters A to I of the distribution (the last index).
extern const float kShape[3][2][10][6][9];
/// The mean radiance [W/(m^2 sr)], integrated over wavelengths.
extern const float kMeanRadiance[3][2][10][6];

}  // namespace pharos::hosek_wilkie
