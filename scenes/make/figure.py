"""Writes figure.obj, a jointed figure of quads that walks in figure.ron, and figure_breath.obj, the same with a wider chest.

    python3 scenes/make/figure.py

Vertices are ordered by the parts of the body, so that a group of the motion is a few ranges of them; these are printed.
"""

import math

import obj
from cage import box, mirrored, outside

# Lattice: x to the figure's left (mirrored about plane 0), y upwards, z forwards.
Y = [0.0, 0.15, 0.72, 0.98, 1.55, 1.85, 2.12, 2.40, 2.86, 3.04, 3.22, 3.52, 3.78]
ARM_X = {3: 0.84, 4: 1.24, 5: 1.42, 6: 1.98, 7: 2.36}
SHOULDER = (0.42, 2.68)
DROP = math.radians(48)  # of the arms below the horizontal, at rest

PARTS = ["hips", "chest", "head", "shoulder", "upper_arm", "forearm", "thigh", "shin", "foot"]


def cells():
    half = box((1, 0, 0), (2, 4, 2)) | {(1, 0, 2)}  # leg, and the front of the foot
    half |= box((0, 4, 0), (2, 8, 2))  # trunk
    half |= box((0, 8, 0), (1, 9, 2))  # neck
    half |= box((0, 9, 0), (2, 12, 2))  # head
    half |= box((2, 7, 0), (7, 8, 2))  # arm
    return mirrored(half)


def place(point):
    i, j, k = point
    side, i = (-1 if i < 0 else 1), abs(i)
    depth = k - 1  # -1 back, 0 middle, 1 front, 2 toes
    if i >= 3:
        x, y, z = arm(i, j, depth)
    elif j <= 3:
        x, y, z = leg(i, j, depth)
    elif j >= 9:
        x, y, z = head(i, j, depth)
    else:
        x, y, z = trunk(i, j, depth)
    return (side * x, y, z)


def arm(i, j, depth):
    along = ARM_X[i] - SHOULDER[0]
    thick = {3: 0.20, 4: 0.185, 5: 0.17, 6: 0.12, 7: 0.10}[i]
    wide = thick if i < 7 else 0.16
    across = thick if j == 8 else -thick
    # The elbow is a little bent already.
    bend = DROP - (0.10 if i >= 5 else 0.0)
    x = SHOULDER[0] + along * math.cos(bend) + across * math.sin(bend)
    y = SHOULDER[1] - along * math.sin(bend) + across * math.cos(bend)
    return x, y, wide * depth + (0.10 if i >= 6 else 0.03 if i == 5 else 0.0)


def leg(i, j, depth):
    middle = 0.27
    half = {0: 0.17, 1: 0.13, 2: 0.17, 3: 0.20}[j]
    x = middle + (half if i == 2 else -half)
    if j == 0 or depth == 2:
        z = [-0.24, 0.0, 0.24, 0.62][depth + 1]
        y = Y[j] - (0.03 if depth == 2 and j == 1 else 0.0)
        return x + (0.04 if depth == 2 else 0.0), y, z
    back = {1: 0.17, 2: 0.21, 3: 0.22}[j]
    return x, Y[j], back * depth - (0.03 if j == 2 else 0.0)


def trunk(i, j, depth):
    width = {4: 0.47, 5: 0.42, 6: 0.47, 7: 0.50, 8: 0.50}[j]
    deep = {4: 0.30, 5: 0.27, 6: 0.30, 7: 0.34, 8: 0.20}[j]
    if j == 8 and i < 2:
        return 0.15 * i, Y[8] + 0.03, 0.15 * depth
    x = width * i / 2
    y = Y[j] - (0.07 if j == 4 and i == 0 else 0.0)
    if j == 4 and i == 1:
        x = 0.09
    return x, y, deep * depth * (1 - 0.12 * (i == 2))


def head(i, j, depth):
    width = {9: 0.24, 10: 0.37, 11: 0.40, 12: 0.24}[j]
    deep = {9: 0.17, 10: 0.40, 11: 0.42, 12: 0.24}[j]
    if j == 9 and i < 2:
        return 0.13 * i, Y[9], 0.13 * depth
    z = deep * depth * (1 - 0.2 * (i == 2)) + 0.03
    return width * i / 2, Y[j] + (0.02 if j == 9 else 0.0) + (0.10 if j == 12 and i < 2 and depth == 0 else 0.03 if j == 12 and i < 2 else 0), z


def part(point):
    """The name of the part; of arms and legs with the side."""
    i, j, _ = point
    side = "_right" if i < 0 else "_left"
    i = abs(i)
    if i >= 3:
        return {3: "shoulder", 4: "upper_arm"}.get(i, "forearm") + side
    if j <= 3:
        return {0: "foot", 1: "foot" if point[2] == 3 else "shin", 2: "shin", 3: "thigh"}[j] + side
    return "head" if j >= 9 else "chest" if j >= 6 else "hips"


def rank(name):
    return PARTS.index(name.removesuffix("_left").removesuffix("_right"))


def breath(vertex, name):
    x, y, z = vertex
    if name != "chest" or y > 2.75:
        return vertex
    return (1.02 * x, y + 0.02, 1.10 * z + 0.02)


def main():
    points, faces, _ = outside(cells())
    names = [part(p) for p in points]
    order = sorted(range(len(points)), key=lambda v: (rank(names[v]), names[v], points[v]))
    new = {old: number for number, old in enumerate(order)}
    vertices = [place(points[old]) for old in order]
    names = [names[old] for old in order]
    faces = [tuple(new[v] for v in face) for face in faces]
    obj.write("figure.obj", "A jointed figure of quads, 3.8 high; it looks along +z, y is up.", vertices, faces)
    breathing = [breath(v, name) for v, name in zip(vertices, names)]
    obj.write("figure_breath.obj", "figure.obj, breathing in: the same faces and vertices, the chest wider.", breathing, faces)
    for name in sorted(set(names), key=names.index):
        print(f"{name}: ({names.index(name)}, {len(names) - 1 - names[::-1].index(name)})")


if __name__ == "__main__":
    main()
