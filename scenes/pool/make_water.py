#!/usr/bin/env python3
"""Writes the water of this scene: a sum of sine waves over [-1,1] x [-1.5,1.5], as binary PLY with normals."""
import math
import struct

WAVES = [  # direction [degrees], length, height, phase
    (17, 0.92, 0.0100, 0.3), (74, 0.61, 0.0065, 1.9), (-38, 0.47, 0.0046, 4.1), (121, 0.36, 0.0031, 0.8),
    (50, 0.27, 0.0021, 2.6), (-80, 0.22, 0.0015, 5.5), (5, 0.17, 0.0010, 3.3),
]
COLUMNS, ROWS = 64, 96


def surface(x, z):
    """Height and its two slopes."""
    y = dx = dz = 0.0
    for degrees, length, height, phase in WAVES:
        k = 2 * math.pi / length
        cx, cz = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        angle = k * (cx * x + cz * z) + phase
        y += height * math.sin(angle)
        dx += height * k * cx * math.cos(angle)
        dz += height * k * cz * math.cos(angle)
    return y, dx, dz


vertices, faces = [], []
for j in range(ROWS + 1):
    for i in range(COLUMNS + 1):
        x, z = 2 * i / COLUMNS - 1, 3 * j / ROWS - 1.5
        y, dx, dz = surface(x, z)
        n = math.sqrt(dx * dx + dz * dz + 1)
        vertices.append((x, y, z, -dx / n, 1 / n, -dz / n))
for j in range(ROWS):
    for i in range(COLUMNS):
        a = j * (COLUMNS + 1) + i
        c = a + COLUMNS + 1
        faces += [(a, c, a + 1), (a + 1, c, c + 1)]
with open("water.ply", "wb") as f:
    f.write(("ply\nformat binary_little_endian 1.0\n"
             f"element vertex {len(vertices)}\n"
             + "".join(f"property float {k}\n" for k in ("x", "y", "z", "nx", "ny", "nz"))
             + f"element face {len(faces)}\nproperty list uchar ushort vertex_indices\n"
             "end_header\n").encode())
    for v in vertices:
        f.write(struct.pack("<6f", *v))
    for face in faces:
        f.write(struct.pack("<B3H", 3, *face))
