"""Writes starfish.obj: a closed control mesh of triangles with poles of valence 10.

    python3 scenes/make/starfish.py
"""

import math

import obj

ARMS = 5
# Rings from the top to the bottom: how far along the arms, their half width, radius between two arms, and the heights of the middle of an
# arm, of its sides, and between two arms.
RINGS = [
    (0.95, 0.50, 0.80, 0.66, 0.50, 0.42),
    (1.70, 0.40, 0.92, 0.54, 0.34, 0.18),
    (2.45, 0.30, 0.96, 0.42, 0.20, 0.02),
    (2.85, 0.20, 0.96, 0.16, 0.06, -0.10),
    (2.40, 0.28, 0.90, -0.08, -0.06, -0.14),
    (1.50, 0.36, 0.80, -0.14, -0.14, -0.18),
]
# The first and the last ring have no sides: along the arms, between them, and the two heights.
INNER = [(0.50, 0.42, 0.80, 0.66), (0.70, 0.50, -0.16, -0.18)]
TOP, BOTTOM = 0.74, -0.10
BEND = 0.035  # radians times the square of the radius: the arms bend, all the same way


def at_angle(arm, along, aside, y):
    angle = 2 * math.pi * arm / ARMS
    x, z = along * math.sin(angle) + aside * math.cos(angle), along * math.cos(angle) - aside * math.sin(angle)
    turn = BEND * (along * along + aside * aside)
    return (x * math.cos(turn) + z * math.sin(turn), y, z * math.cos(turn) - x * math.sin(turn))


def main():
    vertices = [(0.0, TOP, 0.0)]
    index = {}

    def ring(name, points):
        index[name] = list(range(len(vertices), len(vertices) + len(points)))
        vertices.extend(points)

    def inner(name, values):
        along, between, y, low = values
        points = []
        for arm in range(ARMS):
            points += [at_angle(arm, along, 0.0, y), at_angle(arm + 0.5, between, 0.0, low)]
        ring(name, points)

    inner("top", INNER[0])
    for number, (along, width, between, middle, sides, low) in enumerate(RINGS):
        points = []
        for arm in range(ARMS):
            points += [at_angle(arm, along, 0.0, middle), at_angle(arm, 0.96 * along, width, sides)]
            points += [at_angle(arm + 0.5, between, 0.0, low), at_angle(arm + 1, 0.96 * along, -width, sides)]
        ring(number, points)
    inner("bottom", INNER[1])
    vertices.append((0.0, BOTTOM, 0.0))
    few, many = 2 * ARMS, 4 * ARMS

    faces = [(0, index["top"][k], index["top"][(k + 1) % few]) for k in range(few)]
    faces += fan(index["top"], index[0])
    for number in range(len(RINGS) - 1):
        upper, lower = index[number], index[number + 1]
        for k in range(many):
            a, b, c, d = upper[k], lower[k], lower[(k + 1) % many], upper[(k + 1) % many]
            # Mirrored about the middles of the arms.
            faces += [(a, b, c), (a, c, d)] if k % 4 in (0, 1) else [(a, b, d), (b, c, d)]
    faces += [tuple(reversed(face)) for face in fan(index["bottom"], index[len(RINGS) - 1])]
    last = len(vertices) - 1
    faces += [(last, index["bottom"][(k + 1) % few], index["bottom"][k]) for k in range(few)]
    obj.write("starfish.obj", "A starfish of triangles; five arms, y is up.", vertices, faces)


def fan(few, many):
    """From a ring to one with twice as many vertices outside it."""
    faces = []
    for k, inside in enumerate(few):
        after = few[(k + 1) % len(few)]
        a, side, b = (many[(2 * k + i) % len(many)] for i in range(3))
        faces += [(inside, a, side), (inside, side, after), (after, side, b)]
    return faces


if __name__ == "__main__":
    main()
