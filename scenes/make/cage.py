"""Control meshes of quads: the outside of a set of lattice cells, placed by a function; covariances of their vertices.

A lattice point is a triple of integers. A cell is named by its least corner. Along an axis that goes round, the first plane of points
follows the last one.
"""

import math

import obj

# The faces of a cell: the axis, the side, and the corners, counter-clockwise seen from outside.
SIDES = [
    ((-1, 0, 0), [(0, 0, 0), (0, 0, 1), (0, 1, 1), (0, 1, 0)]),
    ((1, 0, 0), [(1, 0, 0), (1, 1, 0), (1, 1, 1), (1, 0, 1)]),
    ((0, -1, 0), [(0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1)]),
    ((0, 1, 0), [(0, 1, 0), (0, 1, 1), (1, 1, 1), (1, 1, 0)]),
    ((0, 0, -1), [(0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0)]),
    ((0, 0, 1), [(0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]),
]


def box(low, high):
    """The cells between two lattice points."""
    return {(i, j, k) for i in range(low[0], high[0]) for j in range(low[1], high[1]) for k in range(low[2], high[2])}


def outside(cells, period=None):
    """(points, faces, sides) of the faces between cells and what is none: lattice points, faces as tuples of their indices, and the
    direction in the lattice that each face looks in. `period`: after how many cells the third axis goes round."""

    def wrap(point):
        i, j, k = point
        return (i, j, k % period) if period else (i, j, k)

    index, points, faces, sides = {}, [], [], []
    for cell in sorted(cells):
        for side, corners in SIDES:
            if wrap(tuple(a + b for a, b in zip(cell, side))) in cells:
                continue
            face = []
            for corner in corners:
                point = wrap(tuple(a + b for a, b in zip(cell, corner)))
                if point not in index:
                    index[point] = len(points)
                    points.append(point)
                face.append(index[point])
            faces.append(tuple(face))
            sides.append(side)
    return points, faces, sides


def edges(faces):
    """Edge (smaller vertex first) to the faces at it."""
    found = {}
    for number, face in enumerate(faces):
        for a, b in zip(face, face[1:] + face[:1]):
            found.setdefault((min(a, b), max(a, b)), []).append(number)
    return found


def mirrored(half, plane=0):
    """Cells and their mirror images about the plane `plane` of the first axis."""
    return half | {(2 * plane - 1 - i, j, k) for i, j, k in half}


def add(a, b):
    return tuple(x + y for x, y in zip(a, b))


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def times(s, a):
    return tuple(s * x for x in a)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    length = math.sqrt(dot(a, a))
    return times(1 / length, a)


def mean(points):
    points = list(points)
    return times(1 / len(points), tuple(sum(c) for c in zip(*points)))


# Symmetric matrices as (xx, xy, xz, yy, yz, zz).


def inverse(s):
    xx, xy, xz, yy, yz, zz = s
    a, b, c = yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy
    det = xx * a + xy * b + xz * c
    return tuple(v / det for v in (a, b, c, xx * zz - xz * xz, xy * xz - xx * yz, xx * yy - xy * xy))


def disk(normal, along, across):
    """Standard deviation `along` in the plane with this normal, `across` in its direction."""
    n, a2, d = unit(normal), along * along, across * across - along * along
    pairs = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)]
    return tuple((a2 if i == j else 0.0) + d * n[i] * n[j] for i, j in pairs)


def ball(deviation):
    return disk((0, 0, 1), deviation, deviation)


def needle(direction, along, across):
    """Standard deviation `along` in this direction, `across` in all others."""
    return disk(direction, across, along)


def normals(vertices, faces):
    """The unit normal of each face."""

    def of(face):
        origin = vertices[face[0]]
        parts = [cross(minus(vertices[b], origin), minus(vertices[c], origin)) for b, c in zip(face[1:], face[2:])]
        return unit(tuple(sum(c) for c in zip(*parts)))

    return [of(face) for face in faces]


def inferred(vertices, faces, flatness, size=0.5):
    """The covariance of each vertex as the product of flat Gaussians in its faces, as Preiner et al. (2019) infer them: flat beside flat
    faces, long along edges, small at corners. `flatness`: across over along; `size`: deviation along, in lengths of the edges."""
    inverses = [(0.0,) * 6 for _ in vertices]
    for face, normal in zip(faces, normals(vertices, faces)):
        length = sum(math.dist(vertices[a], vertices[b]) for a, b in zip(face, face[1:] + face[:1])) / len(face)
        flat = inverse(disk(normal, size * length, flatness * size * length))
        for v in face:
            inverses[v] = add(inverses[v], flat)
    return [inverse(s) for s in inverses]


def write_covariances(name, comment, covariances):
    """A .cov file beside a model; see the crate keyleaf-scene for its format."""
    lines = [f"# {line}" for line in comment.splitlines()]
    lines.append(f"covariances {len(covariances)}")
    lines += [" ".join(f"{value + 0.0:.7g}" for value in covariance) for covariance in covariances]
    (obj.SCENES / name).write_text("\n".join(lines) + "\n", encoding="ascii")
