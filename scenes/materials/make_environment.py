#!/usr/bin/env python3
"""Writes studio.hdr, the environment of this scene: a dark room with three soft boxes.

Latitude-longitude, +y up, the middle of the image towards +z; Radiance RGBE without compression.
"""
import math

WIDTH, HEIGHT = 256, 128

# Direction, half-angles across and up [degrees], softness of the edge [degrees], radiance.
LAMPS = [
    ((-0.8, 0.7, 0.5), (24, 16), 3, (14, 12.6, 10.5)),
    ((0.95, 0.35, 0.1), (8, 32), 2, (3.2, 4.4, 6.4)),
    ((0.1, 0.25, -1.0), (40, 5), 2, (4.5, 2.4, 1.5)),
]


def ramp(x):
    """From 0 at 0 to 1 at 1, smooth at both ends."""
    x = min(max(x, 0.0), 1.0)
    return x * x * (3 - 2 * x)


def direction(column, row):
    phi = 2 * math.pi * (column + 0.5) / WIDTH
    theta = math.pi * (row + 0.5) / HEIGHT
    return (math.sin(phi) * math.sin(theta), math.cos(theta), -math.cos(phi) * math.sin(theta))


def lamp_share(d, towards, half_angles, softness):
    """How much of a lamp is seen in direction d: 1 within, 0 outside, soft between."""
    length = math.sqrt(sum(c * c for c in towards))
    z = [c / length for c in towards]
    across = math.hypot(z[0], z[2])
    x = (z[2] / across, 0.0, -z[0] / across)
    y = (z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0])
    dx, dy, dz = (sum(a * b for a, b in zip(d, axis)) for axis in (x, y, z))
    if dz <= 0:
        return 0.0
    share = 1.0
    for offset, half in zip((dx, dy), half_angles):
        share *= ramp((half - math.degrees(math.atan2(abs(offset), dz))) / softness + 0.5)
    return share


def radiance(d):
    sky = 0.5 + 0.5 * d[1]
    color = [0.05 + 0.16 * sky, 0.05 + 0.18 * sky, 0.05 + 0.23 * sky]
    for towards, half_angles, softness, light in LAMPS:
        share = lamp_share(d, towards, half_angles, softness)
        color = [c + share * l for c, l in zip(color, light)]
    return color


def rgbe(color):
    """Three mantissas and a common exponent (Ward 1991)."""
    _, exponent = math.frexp(max(color))
    return bytes([*(int(c * 2.0 ** (8 - exponent)) for c in color), exponent + 128])


with open("studio.hdr", "wb") as f:
    f.write(f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {HEIGHT} +X {WIDTH}\n".encode())
    for row in range(HEIGHT):
        for column in range(WIDTH):
            f.write(rgbe(radiance(direction(column, row))))
