#!/usr/bin/env python3
"""Writes the turned meshes of this scene: profiles revolved about +y, as binary PLY with normals.

A profile is a list of (radius, height) from the bottom to the top along the outside (and back down
along the inside for glass), smoothed by a Catmull-Rom spline; a repeated point makes a sharp edge.
"""
import math
import struct


def spline(points, steps):
    """Catmull-Rom through runs of points between sharp edges; yields runs of (r, y, dr, dy)."""
    runs, run = [], [points[0]]
    for previous, point in zip(points, points[1:]):
        if point == previous:
            runs.append(run)
            run = []
        run.append(point)
    runs.append(run)
    for run in runs:
        padded = [run[0]] + run + [run[-1]]
        out = []
        for a, b, c, d in zip(padded, padded[1:], padded[2:], padded[3:]):
            for i in range(steps):
                t = i / steps
                out.append(tuple(
                    0.5 * (2 * b[k] + (c[k] - a[k]) * t + (2 * a[k] - 5 * b[k] + 4 * c[k] - d[k]) * t**2
                           + (3 * b[k] - a[k] - 3 * c[k] + d[k]) * t**3) for k in (0, 1)))
        out.append(run[-1])
        samples = []
        for i, (r, y) in enumerate(out):
            (r0, y0), (r1, y1) = out[max(i - 1, 0)], out[min(i + 1, len(out) - 1)]
            samples.append((max(r, 0.0), y, r1 - r0, y1 - y0))
        yield samples


def write(name, profile, steps=4, segments=72):
    vertices, faces = [], []
    for run in spline(profile, steps):
        base = len(vertices)
        for r, y, dr, dy in run:
            length = math.hypot(dr, dy)
            nr, ny = dy / length, -dr / length
            for j in range(segments):
                c, s = math.cos(2 * math.pi * j / segments), math.sin(2 * math.pi * j / segments)
                vertices.append((r * c, y, -r * s, nr * c, ny, -nr * s))
        for i in range(len(run) - 1):
            for j in range(segments):
                a, b = base + i * segments + j, base + i * segments + (j + 1) % segments
                c, d = a + segments, b + segments
                if run[i][0] > 0:
                    faces.append((a, b, d))
                if run[i + 1][0] > 0:
                    faces.append((a, d, c))
    with open(name, "wb") as f:
        f.write(("ply\nformat binary_little_endian 1.0\n"
                 f"element vertex {len(vertices)}\n"
                 + "".join(f"property float {k}\n" for k in ("x", "y", "z", "nx", "ny", "nz"))
                 + f"element face {len(faces)}\nproperty list uchar int vertex_indices\n"
                 "end_header\n").encode())
        for v in vertices:
            f.write(struct.pack("<6f", *v))
        for t in faces:
            f.write(struct.pack("<B3i", 3, *t))


# A wine glass, 1 high: foot, stem, bowl, and back down inside the bowl.
write("goblet.ply", [
    (0, 0), (0.16, 0), (0.27, 0.004), (0.27, 0.012), (0.16, 0.03), (0.05, 0.06), (0.028, 0.14), (0.026, 0.3),
    (0.035, 0.4), (0.09, 0.455), (0.2, 0.54), (0.26, 0.66), (0.262, 0.8), (0.235, 1.0), (0.228, 1.004),
    (0.221, 1.0), (0.246, 0.8), (0.244, 0.665), (0.187, 0.555), (0.085, 0.48), (0, 0.465)])
# A decanter, 1.25 high, thick-walled.
write("decanter.ply", [
    (0, 0), (0.3, 0), (0.42, 0.01), (0.445, 0.06), (0.44, 0.2), (0.38, 0.42), (0.22, 0.62), (0.1, 0.78),
    (0.075, 0.95), (0.085, 1.12), (0.14, 1.24), (0.132, 1.25), (0.124, 1.24), (0.068, 1.12), (0.058, 0.95),
    (0.08, 0.78), (0.2, 0.6), (0.35, 0.41), (0.405, 0.2), (0.4, 0.08), (0.3, 0.045), (0, 0.05)])
# A metal bowl on a foot.
write("bowl.ply", [
    (0, 0), (0.2, 0), (0.26, 0.01), (0.25, 0.03), (0.14, 0.07), (0.12, 0.1), (0.2, 0.16), (0.38, 0.28),
    (0.5, 0.46), (0.53, 0.52), (0.52, 0.527), (0.51, 0.52), (0.48, 0.47), (0.36, 0.31), (0.19, 0.2), (0, 0.17)])
