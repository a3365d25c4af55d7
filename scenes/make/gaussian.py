"""Writes gauss_cube, gauss_wirecube, gauss_cylinder and gauss_anvil (.obj and .cov): control meshes with covariances, in the manner of
the test set of Komar 2020, chapter 4.

    python3 scenes/make/gaussian.py
"""

import math

import obj
from cage import add, ball, box, cross, disk, inferred, needle, outside, times, write_covariances


def write(name, what, vertices, faces, covariances):
    obj.write(f"{name}.obj", what, vertices, faces)
    write_covariances(f"{name}.cov", f"Covariances of {name}.obj.", covariances)


def cube():
    """Flat Gaussians across the diagonals: the surface leaves the eight corners sideways and becomes a round octahedron."""
    points, faces, _ = outside(box((0, 0, 0), (1, 1, 1)))
    vertices = [times(2, add(p, (-0.5, -0.5, -0.5))) for p in points]
    covariances = [disk(p, 0.6, 0.15) for p in vertices]
    write("gauss_cube", "A cube whose surface is a round octahedron.", vertices, faces, covariances)


def wirecube():
    """The frame of a cube, with 40 vertices and 48 faces as Komar's: beams that are long along the edges, and round knots."""
    corner = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    vertices = [times(1.0, c) for c in corner] + [times(0.56, c) for c in corner]
    directions = [None] * 16
    faces = []
    for axis in range(3):
        for side in (-1, 1):
            a, b = [(1, 2), (2, 0), (0, 1)][axis]
            ring = []
            for s, t in [(-1, -1), (1, -1), (1, 1), (-1, 1)][:: side]:
                point = [0, 0, 0]
                point[axis], point[a], point[b] = side, s, t
                ring.append(tuple(point))
            holes = []
            for point in ring:
                hole = [0.56 * c for c in point]
                hole[axis] = float(point[axis])
                holes.append(len(vertices))
                vertices.append(tuple(hole))
            outer = [corner.index(p) for p in ring]
            inner = [8 + corner.index(p) for p in ring]
            for k in range(4):
                m = (k + 1) % 4
                faces.append((outer[k], outer[m], holes[m], holes[k]))
                faces.append((holes[k], holes[m], inner[m], inner[k]))
    covariances = []
    for number, point in enumerate(vertices):
        if number < 8:
            covariances.append(ball(0.07))
        elif number < 16:
            covariances.append(needle(point, 0.12, 0.3))
        else:
            normal = tuple(c if abs(c) == 1 else 0 for c in point)
            covariances.append(disk(normal, 0.3, 0.1))
    write("gauss_wirecube", "The frame of a cube: 40 vertices, 48 faces, genus 5.", vertices, faces, covariances)


def cylinder():
    """A drum: caps that are flat up to a sharp rim, a waist drawn in, 8 sides."""
    sides, rings = 8, [(1.0, -1.15), (0.98, -0.55), (0.62, 0.1), (0.98, 0.7), (1.0, 1.15)]
    vertices, faces = [], []
    for radius, y in rings:
        turn = [2 * math.pi * k / sides for k in range(sides)]
        vertices += [(radius * math.sin(a), y, radius * math.cos(a)) for a in turn]
    for lower in range(len(rings) - 1):
        for k in range(sides):
            a, b = sides * lower + k, sides * lower + (k + 1) % sides
            faces.append((a, b, b + sides, a + sides))
    bottom, top = len(vertices), len(vertices) + 1
    vertices += [(0.0, rings[0][1], 0.0), (0.0, rings[-1][1], 0.0)]
    last = sides * (len(rings) - 1)
    for k in range(0, sides, 2):
        a, b, c = k, k + 1, (k + 2) % sides
        faces += [(c, b, a, bottom), (last + a, last + b, last + c, top)]
    covariances = []
    for number, (x, y, z) in enumerate(vertices):
        ring = number // sides
        if number in (bottom, top):
            covariances.append(disk((0, 1, 0), 0.6, 0.01))
        elif ring in (0, len(rings) - 1):
            # Long along the rim, short in both other directions.
            covariances.append(needle(cross((0, 1, 0), (x, 0, z)), 0.45, 0.03))
        elif ring == 2:
            covariances.append(needle(cross((0, 1, 0), (x, 0, z)), 0.4, 0.12))
        else:
            covariances.append(disk((x, 0, z), 0.35, 0.1))
    write("gauss_cylinder", "A drum with a waist: 42 vertices, 40 faces.", vertices, faces, covariances)


# Lattice of the anvil: x along it (the horn to the right), y upwards, z across it.
ANVIL_X = [-2.3, -1.55, -0.75, 0.0, 0.75, 1.3, 1.9, 2.5, 3.05]
ANVIL_Y = [0.0, 0.32, 0.75, 1.2, 1.5, 2.0]
ANVIL_Z = [-0.95, -0.6, 0.0, 0.6, 0.95]


def anvil_point(point):
    i, j, k = point
    x, y, z = ANVIL_X[i], ANVIL_Y[j], ANVIL_Z[k]
    if j <= 1:
        return (x * 1.05, y, z * 1.05)  # the foot
    if j in (2, 3):
        # The waist, drawn in.
        narrow = 0.62 if j == 2 else 0.74
        return (x * narrow, y, z * narrow)
    horn = max(0.0, (x - 1.3) / 1.75)
    width = (1.0 if horn == 0.0 else 0.95) * math.sqrt(1 - 0.95 * horn**1.2)
    if j == 5:
        return (x, y - (0.12 if horn > 0 else 0.0) - 0.02 * horn, z * width)
    # The underside of heel and horn rises.
    rise = 0.42 * horn**0.8 + (0.1 if i == 0 else 0.0)
    return (x, y - 0.1 + rise, z * width)


def anvil():
    """A flat face with sharp edges, a horn with a round back and a point, a hollow waist, a heavy foot."""
    cells = box((1, 0, 0), (5, 1, 4)) | box((2, 1, 1), (4, 3, 3))
    cells |= box((1, 3, 1), (5, 4, 3))
    cells |= box((0, 4, 1), (8, 5, 3))
    points, faces, sides = outside(cells)
    vertices = [anvil_point(p) for p in points]
    flat = inferred(vertices, faces, 0.07)
    covariances = []
    for point, covariance in zip(points, flat):
        i, j, k = point
        is_waist = 2 <= i <= 4 and 1 <= k <= 3
        if i == 8:
            covariance = ball(0.06)
        elif i >= 6:
            covariance = ball(0.3)
        elif is_waist and 1 <= j <= 3:
            covariance = ball(0.25)
        covariances.append(covariance)
    write("gauss_anvil", "An anvil of quads.", vertices, faces, covariances)


if __name__ == "__main__":
    cube()
    wirecube()
    cylinder()
    anvil()
