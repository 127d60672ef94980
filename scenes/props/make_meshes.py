#!/usr/bin/env python3
"""Writes the soft meshes of the furniture, as binary PLY with normals, within [-1,1]^3.

Each is a level set |x|^across + |y|^upright + |z|^across = 1, met by rays from the origin through a
grid on each face of the cube.
"""
import itertools
import struct

CELLS = 12  # along an edge of the cube


def hit(direction, powers):
    """The point where the ray from the origin leaves the level set, by bisection."""
    low, high = 0.0, 2.0
    for _ in range(50):
        t = (low + high) / 2
        inside = sum(abs(t * d) ** p for d, p in zip(direction, powers)) < 1
        low, high = (t, high) if inside else (low, t)
    return [low * d for d in direction]


def normal(point, powers):
    gradient = [p * abs(c) ** (p - 1) * (1 if c >= 0 else -1) for c, p in zip(point, powers)]
    length = sum(g * g for g in gradient) ** 0.5
    return [g / length for g in gradient]


def write(name, across, upright):
    powers = (across, upright, across)
    vertices, faces = [], []
    for axis, sign in itertools.product(range(3), (1, -1)):
        base = len(vertices)
        for i, j in itertools.product(range(CELLS + 1), repeat=2):
            direction = [0.0, 0.0, 0.0]
            direction[axis] = sign
            direction[(axis + 1) % 3] = 2 * i / CELLS - 1
            direction[(axis + 2) % 3] = sign * (2 * j / CELLS - 1)
            point = hit(direction, powers)
            vertices.append(point + normal(point, powers))
        for i, j in itertools.product(range(CELLS), repeat=2):
            a = base + i * (CELLS + 1) + j
            b, c, d = a + CELLS + 1, a + CELLS + 2, a + 1
            faces += [(a, b, c), (a, c, d)]
    with open(name, "wb") as f:
        f.write(("ply\nformat binary_little_endian 1.0\n"
                 f"element vertex {len(vertices)}\n"
                 + "".join(f"property float {k}\n" for k in ("x", "y", "z", "nx", "ny", "nz"))
                 + f"element face {len(faces)}\nproperty list uchar ushort vertex_indices\n"
                 "end_header\n").encode())
        for v in vertices:
            f.write(struct.pack("<6f", *v))
        for t in faces:
            f.write(struct.pack("<B3H", 3, *t))


write("cushion.ply", 6, 4)
write("pillow.ply", 4, 1.6)
