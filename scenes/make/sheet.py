"""Writes petal.obj: an open sheet of 8 by 4 quads, the petal of a flower that curls outwards.

    python3 scenes/make/sheet.py
"""

import math

import obj

LENGTH, STEPS, WIDE = 3.0, 8, 4


def midrib():
    """(out, up, angle of the direction of growth against the horizontal) at the rows."""
    out, up, rows, fine = 0.10, 0.0, [], 40
    for step in range(STEPS * fine + 1):
        u = step / (STEPS * fine)
        angle = math.radians(80 - 165 * u**1.7)
        if step % fine == 0:
            rows.append((out, up, angle))
        out += LENGTH / (STEPS * fine) * math.cos(angle)
        up += LENGTH / (STEPS * fine) * math.sin(angle)
    return rows


def main():
    vertices, faces, uvs = [], [], []
    for row, (out, up, angle) in enumerate(midrib()):
        u = row / STEPS
        width = 0.10 + 0.78 * math.sin(math.pi * (0.04 + 0.90 * u**0.85)) ** 0.9
        for column in range(WIDE + 1):
            v = 2 * column / WIDE - 1
            # A cup that opens towards the tip, and waves along both sides.
            lift = 0.55 * width * v * v * (1 - 0.8 * u) + 0.13 * u * abs(v) ** 3 * math.sin(9 * u + 1.2 * v)
            x, y = out - lift * math.sin(angle), up + lift * math.cos(angle)
            vertices.append((x, y, width * v))
            uvs.append((u, 0.5 + 0.5 * v))
    for row in range(STEPS):
        for column in range(WIDE):
            a = row * (WIDE + 1) + column
            faces.append((a, a + 1, a + WIDE + 2, a + WIDE + 1))
    comment = "A petal: 8 by 4 quads from its base at the origin outwards along x, upper side up."
    obj.write("petal.obj", comment, vertices, faces, uvs=uvs, face_uvs=faces)


if __name__ == "__main__":
    main()
