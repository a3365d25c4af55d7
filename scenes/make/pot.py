"""Writes pot.bpt: a round pot with lid, overhead handle and spout, of bicubic Bézier patches; every part is closed.

    python3 scenes/make/pot.py
"""

import math

import freeform

# A quarter of a circle as a cubic: the length of its handles.
KAPPA = 4 / 3 * (math.sqrt(2) - 1)
# Twelve control points of a circle, counter-clockwise.
CIRCLE = [(1, 0), (1, KAPPA), (KAPPA, 1), (0, 1), (-KAPPA, 1), (-1, KAPPA)]
CIRCLE += [(-x, -y) for x, y in CIRCLE]


def turned(radius, y):
    """A ring about the y axis."""
    return [(radius * c, y, -radius * s) for c, s in CIRCLE]


def ring(x, y, angle, across, depth):
    """A ring about a path in the plane z = 0 that runs at an angle (degrees, from +x to +y)."""
    nx, ny = -math.sin(math.radians(angle)), math.cos(math.radians(angle))
    return [(x + across * c * nx, y + across * c * ny, depth * s) for c, s in CIRCLE]


def scaled(a, factor):
    return tuple(factor * x for x in a)


def plus(a, b):
    return tuple(x + y for x, y in zip(a, b))


def difference(a, b):
    return tuple(x - y for x, y in zip(a, b))


def loft(rings, corners=(), flat_ends=True):
    """Bicubic patches through rings, smooth but at corners (numbers of rings). Rings at the ends may be points."""
    middles = [scaled(tuple(map(sum, zip(*r))), 1 / len(r)) for r in rings]
    sizes = [max(math.dist(p, m) for p in r) for r, m in zip(rings, middles)]
    lengths = [math.hypot(math.dist(a, b), s - t) for a, b, s, t in zip(middles, middles[1:], sizes, sizes[1:])]

    def slope(k, j):
        return scaled(difference(rings[k + 1][j], rings[k][j]), 1 / lengths[k])

    def tangents(k, j):
        """Derivatives by length before and after ring k at its point j."""
        if k == 0 or k == len(rings) - 1:
            inner = slope(0, j) if k == 0 else slope(k - 1, j)
            if flat_ends:
                inner = (inner[0], 0.0, inner[2])
            return inner, inner
        before, after = slope(k - 1, j), slope(k, j)
        if k in corners:
            return before, after
        a, b = lengths[k - 1], lengths[k]
        mean = plus(scaled(before, b / (a + b)), scaled(after, a / (a + b)))
        return mean, mean

    patches = []
    for k, length in enumerate(lengths):
        rows = [[], [], [], []]
        for j in range(len(CIRCLE)):
            low, high = rings[k][j], rings[k + 1][j]
            rows[0].append(low)
            rows[1].append(plus(low, scaled(tangents(k, j)[1], length / 3)))
            rows[2].append(difference(high, scaled(tangents(k + 1, j)[0], length / 3)))
            rows[3].append(high)
        for quarter in range(4):
            columns = [(3 * quarter + i) % len(CIRCLE) for i in range(4)]
            patches.append([[row[i] for i in columns] for row in rows])
    return patches


def pot():
    # Underside, foot, belly, shoulder, collar, lid, knob; corners at the foot and where the lid lies on the collar.
    outline = [
        (0, 0.1), (0.7, 0.1), (0.84, 0), (0.98, 0), (1.0, 0.12), (1.42, 0.48), (1.6, 0.95), (1.4, 1.42), (0.92, 1.68),
        (0.86, 1.76), (0.84, 1.84), (0.78, 1.86), (0.76, 1.82), (0.74, 1.87), (0.5, 2.0), (0.2, 2.08), (0.12, 2.15),
        (0.2, 2.27), (0.16, 2.38), (0, 2.42),
    ]  # fmt: skip
    corners = {1, 2, 3, 4, 8, 12, 13}
    body = loft([turned(r, y) for r, y in outline], corners)
    # The spout rises to +x; its lip turns inwards and its inside ends in a point.
    spout = loft(
        [
            ring(1.0, 0.55, 20, 0, 0),
            ring(1.12, 0.6, 22, 0.36, 0.42),
            ring(1.5, 0.78, 32, 0.3, 0.33),
            ring(1.84, 1.1, 52, 0.21, 0.22),
            ring(2.05, 1.45, 58, 0.165, 0.17),
            ring(2.3, 1.76, 38, 0.16, 0.17),
            ring(2.42, 1.85, 34, 0.18, 0.19),
            ring(2.43, 1.86, 34, 0.155, 0.165),
            ring(2.3, 1.76, 38, 0.13, 0.14),
            ring(2.08, 1.5, 58, 0.11, 0.11),
            ring(1.98, 1.35, 58, 0, 0),
        ],
        flat_ends=False,
    )
    # The handle is an arch over the lid, from the shoulder at -x to the one at +x.
    arch = [(180 - 15 * k) for k in range(13)]
    handle = [ring(-1.12, 1.3, 90, 0, 0), ring(-1.13, 1.42, 90, 0.13, 0.2)]
    for angle in arch[1:-1]:
        a = math.radians(angle)
        thick = 0.075 + 0.045 * abs(math.cos(a)) ** 2
        handle.append(ring(1.2 * math.cos(a), 1.72 + 1.55 * math.sin(a), angle - 90, thick, 1.55 * thick))
    handle += [ring(1.13, 1.42, -90, 0.13, 0.2), ring(1.12, 1.3, -90, 0, 0)]
    freeform.write_bpt("pot.bpt", body + spout + loft(handle, flat_ends=False))


if __name__ == "__main__":
    pot()
