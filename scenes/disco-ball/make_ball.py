#!/usr/bin/env python3
"""Writes ball.ply: the mirrors of a disco ball of radius 1, flat tiles in rings about +y.

The corners of a tile lie on the sphere, symmetrically, so that it is flat; gaps are left between.
"""
import math
import struct

RINGS = 22
GAP = 0.08  # share of a tile's edge

vertices, faces = [], []
for ring in range(RINGS):
    middle = math.pi * (ring + 0.5) / RINGS
    tiles = max(3, round(2 * RINGS * math.sin(middle)))
    half_height, half_width = math.pi / RINGS / 2 * (1 - GAP), math.pi / tiles * (1 - GAP)
    for tile in range(tiles):
        # Every other ring begins half a tile later.
        phi = 2 * math.pi * (tile + 0.5 * (ring % 2)) / tiles
        base = len(vertices)
        for up, right in ((-1, -1), (-1, 1), (1, 1), (1, -1)):
            theta, azimuth = middle - up * half_height, phi + right * half_width
            vertices.append((math.sin(theta) * math.sin(azimuth), math.cos(theta),
                             math.sin(theta) * math.cos(azimuth)))
        faces += [(base, base + 1, base + 2), (base, base + 2, base + 3)]

with open("ball.ply", "wb") as f:
    f.write(("ply\nformat binary_little_endian 1.0\n"
             f"element vertex {len(vertices)}\n"
             + "".join(f"property float {k}\n" for k in ("x", "y", "z"))
             + f"element face {len(faces)}\nproperty list uchar ushort vertex_indices\n"
             "end_header\n").encode())
    for v in vertices:
        f.write(struct.pack("<3f", *v))
    for t in faces:
        f.write(struct.pack("<B3H", 3, *t))
