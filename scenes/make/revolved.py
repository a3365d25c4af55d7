"""Writes goblet.obj and torus.obj: exact surfaces of revolution about the y axis (Piegl & Tiller 7.5).

    python3 scenes/make/revolved.py
"""

import math

import freeform

HALF = math.sqrt(0.5)
# The circle of nine points, and its weights.
CIRCLE = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)]
CIRCLE_KNOTS = [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4]


def weight(k):
    return HALF if k % 2 else 1.0


def revolve(profile):
    """Rows of control points of a profile of (radius, y, w); counter-clockwise seen from above."""
    return [
        [(r * c, y, -r * s, w * weight(k)) for k, (c, s) in enumerate(CIRCLE)]
        for r, y, w in profile
    ]


def goblet():
    """From the middle of the foot's underside over foot, stem, knop, bowl and lip to the middle of the bowl's inside."""
    profile = [
        (0, 0.14), (0.45, 0.14), (1.1, 0), (1.42, 0), (1.56, 0.02), (1.6, 0.1), (1.5, 0.17), (1.0, 0.24), (0.42, 0.4),
        (0.2, 0.72), (0.15, 1.2), (0.15, 1.62), (0.2, 1.86), (0.52, 1.94), (0.56, 2.2), (0.5, 2.42), (0.2, 2.5),
        (0.15, 2.74), (0.18, 3.0), (0.42, 3.2), (1.25, 3.36), (1.78, 4.1), (1.74, 5.1), (1.5, 6.0), (1.44, 6.3),
        (1.43, 6.37), (1.36, 6.37), (1.36, 6.3), (1.42, 6.0), (1.66, 5.1), (1.68, 4.2), (1.2, 3.52), (0.5, 3.44), (0, 3.44),
    ]  # fmt: skip
    # Each span is as long as its part of the control polygon, which keeps the curve's speed even.
    lengths = [math.dist(a, b) for a, b in zip(profile, profile[1:])]
    breaks = [0.0]
    for k in range(len(profile) - 3):
        breaks.append(round(breaks[-1] + sum(lengths[k : k + 3]) / 3, 3))
    rows = revolve([(r, y, 1.0) for r, y in profile])
    comment = "A goblet: one closed rational surface of degree 2 by 3 with two poles. y is up."
    surface = ("goblet", (2, 3), CIRCLE_KNOTS, freeform.clamped(breaks, 3), rows)
    freeform.write_obj("goblet.obj", comment, [surface])


def torus():
    """Radius 2 to the middle of the tube, tube of radius 0.55: 9 x 9 control points."""
    major, minor = 2.0, 0.55
    profile = [(major + minor * c, minor * s, weight(k)) for k, (c, s) in enumerate(CIRCLE)]
    comment = "A torus: one closed rational surface of degree 2 by 2, exactly round. y is up."
    surface = ("torus", (2, 2), CIRCLE_KNOTS, CIRCLE_KNOTS, revolve(profile))
    freeform.write_obj("torus.obj", comment, [surface])


if __name__ == "__main__":
    goblet()
    torus()
