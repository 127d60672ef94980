#!/usr/bin/env python3
"""Writes sky.hdr, the radiance of the light behind the attic's window: clouds before an evening sky.

Clouds are noise on lattices of four widths, added up; Radiance RGBE without compression.
"""
import math
import random

SIZE = 64
LATTICES = [(3, 0.5), (6, 0.27), (12, 0.15), (24, 0.08)]  # cells along an edge, weight
LOW, HIGH = (1.0, 0.5, 0.22), (0.2, 0.38, 0.75)  # of the sky, at its lower and its upper edge
CLOUD = (1.9, 1.55, 1.2)

random.seed(4)
noise = {cells: [[random.random() for _ in range(cells + 1)] for _ in range(cells + 1)]
         for cells, _ in LATTICES}


def ramp(x):
    """From 0 at 0 to 1 at 1, smooth at both ends."""
    x = min(max(x, 0.0), 1.0)
    return x * x * (3 - 2 * x)


def mix(a, b, share):
    return a + (b - a) * share


def lattice_value(x, y, cells):
    column, row = min(int(x * cells), cells - 1), min(int(y * cells), cells - 1)
    s, t = ramp(x * cells - column), ramp(y * cells - row)
    lower, upper = noise[cells][row], noise[cells][row + 1]
    return mix(mix(lower[column], lower[column + 1], s), mix(upper[column], upper[column + 1], s), t)


def radiance(x, y):
    """At [0,1]^2, y upwards."""
    density = sum(weight * lattice_value(x, y, cells) for cells, weight in LATTICES)
    cover = ramp((density - 0.42) / 0.25)
    return [mix(mix(low, high, y), cloud, cover) for low, high, cloud in zip(LOW, HIGH, CLOUD)]


def rgbe(color):
    """Three mantissas and a common exponent (Ward 1991)."""
    _, exponent = math.frexp(max(color))
    return bytes([*(int(c * 2.0 ** (8 - exponent)) for c in color), exponent + 128])


with open("sky.hdr", "wb") as f:
    f.write(f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {SIZE} +X {SIZE}\n".encode())
    for row in range(SIZE):
        for column in range(SIZE):
            f.write(rgbe(radiance((column + 0.5) / SIZE, 1 - (row + 0.5) / SIZE)))
