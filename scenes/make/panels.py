"""Writes panels.obj: the body of a car as nine cubic surfaces that meet smoothly, cut from one by knot insertion.

    python3 scenes/make/panels.py
"""

import freeform

DEGREE = 3
# Along the car: x, half width, height of the waist, height of the middle, half width of hood, roof and boot lid,
# how far the ends of the section lie behind (in front of) its middle.
STATIONS = [
    (-2.24, 0.76, 0.26, 0.26, 0.68, 0.14),
    (-2.37, 0.80, 0.40, 0.42, 0.70, 0.28),
    (-2.35, 0.84, 0.54, 0.60, 0.74, 0.30),
    (-2.12, 0.87, 0.63, 0.70, 0.77, 0.20),
    (-1.70, 0.90, 0.69, 0.77, 0.78, 0.12),
    (-1.20, 0.91, 0.73, 0.83, 0.78, 0.07),
    (-0.88, 0.91, 0.76, 0.87, 0.78, 0.08),
    (-0.72, 0.91, 0.78, 0.90, 0.75, 0.12),
    (-0.14, 0.91, 0.81, 1.37, 0.63, 0.12),
    (0.20, 0.92, 0.82, 1.40, 0.60, 0.05),
    (0.66, 0.93, 0.83, 1.38, 0.60, 0.0),
    (1.10, 0.94, 0.85, 1.30, 0.60, -0.04),
    (1.62, 0.93, 0.87, 1.03, 0.64, -0.10),
    (1.82, 0.92, 0.88, 0.96, 0.68, -0.10),
    (2.16, 0.89, 0.86, 0.93, 0.70, -0.15),
    (2.34, 0.86, 0.74, 0.82, 0.70, -0.20),
    (2.33, 0.83, 0.45, 0.48, 0.70, -0.17),
    (2.22, 0.80, 0.28, 0.28, 0.70, -0.05),
]
KNOTS_U = [0, 0.5, 1.1, 1.9, 2.8, 3.5, 4.1, 4.9, 5.8, 6.8, 7.9, 8.8, 9.6, 10.2, 10.7, 11.1]
# Across: from the sill over the waist to the middle of the roof, and down again.
KNOTS_V = [0, 0.6, 1.3, 1.9, 2.3, 2.8, 3.4, 4.0, 4.5, 4.9, 5.5, 6.2, 6.8]
# Where the panels meet: hood, cabin, boot; left side, top, right side.
CUTS_U, CUTS_V = [3.5, 8.8], [2.3, 4.5]


def section(station):
    """15 control points from the left sill to the right one."""
    x, width, waist, top, roof, bend = station
    sill = min(0.24, waist)
    lift = waist - sill
    half = [
        (width * 0.95, sill),
        (width * 1.0, sill + 0.12 * lift),
        (width * 1.035, sill + 0.45 * lift),
        (width * 1.035, sill + 0.80 * lift),
        (width * 1.0, waist - 0.01 * lift),
        (width * 0.91, waist + 0.06 * (top - waist)),
        (roof * 1.03, waist + 0.9 * (top - waist)),
        (roof * 0.45, top + 0.02 * lift),
    ]
    outline = [(-z, y) for z, y in half] + [(z, y) for z, y in reversed(half[:-1])]
    # The middle is a little higher, so that nothing is flat.
    outline[len(half) - 1] = (0.0, top + 0.035 * lift)
    return [(x + bend * (z / width) ** 2, y, -z) for z, y in outline]


def insert(knots, points, at):
    """Control points after one more knot (Piegl & Tiller A5.1); points are tuples."""
    span = max(k for k in range(len(knots) - 1) if knots[k] <= at < knots[k + 1])
    fresh = []
    for k in range(len(points) + 1):
        if k <= span - DEGREE:
            fresh.append(points[k])
        elif k > span:
            fresh.append(points[k - 1])
        else:
            part = (at - knots[k]) / (knots[k + DEGREE] - knots[k])
            fresh.append(tuple((1 - part) * a + part * b for a, b in zip(points[k - 1], points[k])))
    return sorted(knots + [at]), fresh


def cut(knots, lines, cuts):
    """(knots, lines) of the parts of curves between cuts, all with the same knots."""
    for at in cuts:
        while knots.count(at) < DEGREE:
            inserted = [insert(knots, line, at) for line in lines]
            knots, lines = inserted[0][0], [line for _, line in inserted]
    parts, first = [], 0
    ends = [at for at in cuts] + [knots[-1]]
    start = knots[0]
    for end in ends:
        inner = [k for k in knots if start < k < end]
        count = DEGREE + 1 + len(inner)
        part = [start] * (DEGREE + 1) + inner + [end] * (DEGREE + 1)
        parts.append((part, [line[first : first + count] for line in lines]))
        first += count - 1
        start = end
    return parts


def panels():
    columns = [section(station) for station in STATIONS]
    rows = [list(row) for row in zip(*columns)]
    surfaces = []
    names = [["fender left", "door left", "quarter left"], ["hood", "roof", "boot"], ["fender right", "door right", "quarter right"]]
    along = cut(freeform.clamped(KNOTS_U, DEGREE), rows, CUTS_U)
    for i, (knots_u, part) in enumerate(along):
        across = cut(freeform.clamped(KNOTS_V, DEGREE), [list(column) for column in zip(*part)], CUTS_V)
        for j, (knots_v, lines) in enumerate(across):
            net = [[(*point, 1.0) for point in row] for row in zip(*lines)]
            surfaces.append((names[j][i], (DEGREE, DEGREE), knots_u, knots_v, net))
    comment = "The body of a car: nine cubic surfaces with knots of their own, joined; open below. x is backwards, y is up."
    freeform.write_obj("panels.obj", comment, surfaces)


if __name__ == "__main__":
    panels()
