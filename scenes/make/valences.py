"""Writes valences.obj: ten closed stars of quads whose two poles have valence 3 to 12.

    python3 scenes/make/valences.py

Between the poles are rings of 2n vertices; their radii alternate, so that each star has n points.
"""

import colorsys
import math

import obj
from cage import add

# (radius at a point of the star, radius between two, height), from the top pole to the bottom one.
RINGS = [(0.62, 0.50, 0.62), (1.22, 0.72, 0.30), (1.22, 0.72, -0.22), (0.70, 0.55, -0.50)]
TOP, BOTTOM = 0.50, -0.42  # the poles lie in hollows
SPACING = 3.0
COLUMNS = 5


def star(n):
    vertices = [(0.0, TOP, 0.0)]
    for outer, inner, y in RINGS:
        for k in range(2 * n):
            r, angle = (outer, inner)[k % 2], math.pi * k / n
            vertices.append((r * math.sin(angle), y, r * math.cos(angle)))
    vertices.append((0.0, BOTTOM, 0.0))
    last = len(vertices) - 1

    def at(ring, k):
        return 1 + 2 * n * ring + k % (2 * n)

    # A quad at a pole has its far corner in a point of the star.
    faces = [(0, at(0, k - 1), at(0, k), at(0, k + 1)) for k in range(0, 2 * n, 2)]
    for ring in range(len(RINGS) - 1):
        faces += [(at(ring, k), at(ring + 1, k), at(ring + 1, k + 1), at(ring, k + 1)) for k in range(2 * n)]
    low = len(RINGS) - 1
    faces += [(last, at(low, k + 1), at(low, k), at(low, k - 1)) for k in range(0, 2 * n, 2)]
    return vertices, faces


def main():
    vertices, faces, colours = [], [], []
    for number, n in enumerate(range(3, 13)):
        column, row = number % COLUMNS, number // COLUMNS
        place = (SPACING * (column - (COLUMNS - 1) / 2), 0.0, SPACING * (row - 0.5))
        points, quads = star(n)
        first = len(vertices)
        vertices += [add(p, place) for p in points]
        faces += [tuple(first + v for v in quad) for quad in quads]
        colours += [colorsys.hls_to_rgb(0.04 + 0.085 * number, 0.62, 0.55)] * len(points)
    comment = "Ten stars whose poles have valence 3 to 12, in two rows from left to right, the first row behind."
    obj.write("valences.obj", comment, vertices, faces, colours)


if __name__ == "__main__":
    main()
