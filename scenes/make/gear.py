"""Writes gear.obj: a wheel with teeth, web, holes and hub, whose edges are sharp in several ways.

    python3 scenes/make/gear.py

The cells of a lattice in polar coordinates: radius, height, angle. Edges where faces of different directions meet are creases:

| where | sharpness |
|---|---|
| bore and ends of the hub | 10, for ever |
| tops and flanks of the teeth | 3 |
| rim | 2 |
| rounds of the holes in the web | 1.5 |
| where hub and rim meet the web | 0: a fillet |
"""

import math

import obj
from cage import edges, outside

TEETH = 12
STEPS = 3  # cells a tooth: tooth, flank side, gap
PERIOD = TEETH * STEPS
RADII = [0.55, 0.95, 1.25, 1.95, 2.3, 2.5, 3.1]
HEIGHTS = [-0.75, -0.5, -0.16, 0.16, 0.5, 0.75]
HUB, WEB, RIM, TOOTH = (0, 1), (1, 4), (4, 5), (5, 6)
SPOKES = 6


def cells():
    found = set()
    for k in range(PERIOD):
        found |= {(i, j, k) for i in range(*HUB) for j in range(0, 5)}
        found |= {(i, 2, k) for i in range(*WEB)}
        found |= {(i, j, k) for i in range(*RIM) for j in range(1, 4)}
        if k % STEPS == 0:
            found |= {(i, j, k) for i in range(*TOOTH) for j in range(1, 4)}
        if k % (PERIOD // SPOKES) in (1, 2, 3, 4):
            found.discard((2, 2, k))
    return found


def place(point):
    i, j, k = point
    radius, y, phase = RADII[i], HEIGHTS[j], k % STEPS
    angle = 2 * math.pi * k / PERIOD
    if i >= 5 and phase < 2:
        # A tooth becomes narrower outwards.
        middle = 2 * math.pi * (k - phase + 0.5) / PERIOD
        angle = middle + (angle - middle) * (1.35 if i == 5 else 0.75)
    if i == 6:
        y *= 0.86
    return (radius * math.cos(angle), y, radius * math.sin(angle))


def sharpness(points, edge):
    """Of an edge whose faces look in two directions of the lattice."""
    (i, j, k), (l, m, n) = (points[v] for v in edge)
    if max(i, l) <= 1:
        if j == m and j not in (0, 5):
            return 0.0
        return 10.0 if (i == l or j == m) and not (i == 1 and j in (2, 3)) else 0.0
    if min(i, l) >= 5:
        return 3.0
    if i == l and i in (2, 3) and j == m:
        return 1.5
    if i == l and i in (4, 5) and j in (1, 4):
        return 2.0
    return 0.0


def main():
    points, faces, sides = outside(cells(), PERIOD)
    vertices = [place(p) for p in points]
    creases = []
    for edge, (first, second) in sorted(edges(faces).items()):
        if sides[first] != sides[second]:
            value = sharpness(points, edge)
            if value > 0:
                creases.append((*edge, value))
    comment = "A wheel with 12 teeth, 6 holes and a hub. Creases: bore 10, teeth 3, rim 2, holes 1.5."
    obj.write("gear.obj", comment, vertices, faces, creases=creases)


if __name__ == "__main__":
    main()
