"""Writes cube.obj, mixed.obj, thin.obj and open.obj.

    python3 scenes/make/shapes.py
"""

import math

import obj


def cube():
    """Side 2 about the origin; every face has the whole unit square as its texture coordinates."""
    vertices = [(x, y, z) for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)]
    faces = [(4, 5, 7, 6), (1, 0, 2, 3), (5, 1, 3, 7), (0, 4, 6, 2), (6, 7, 3, 2), (0, 1, 5, 4)]
    uvs = [(0, 0), (1, 0), (1, 1), (0, 1)]
    comment = "A cube of side 2: front, back, right, left, top, bottom (y is up)."
    obj.write("cube.obj", comment, vertices, faces, uvs=uvs, face_uvs=[(0, 1, 2, 3)] * 6)


class Builder:
    """Vertices by position, so that parts which touch share them."""

    def __init__(self):
        self.vertices, self.faces, self.index = [], [], {}

    def vertex(self, x, y, z):
        key = (round(x, 6) + 0.0, round(y, 6) + 0.0, round(z, 6) + 0.0)
        if key not in self.index:
            self.index[key] = len(self.vertices)
            self.vertices.append(key)
        return self.index[key]

    def face(self, *points):
        self.faces.append(tuple(self.vertex(*p) for p in points))

    def band(self, lower, upper):
        """Quads between two closed rings that run counter-clockwise seen from the end of `upper`."""
        n = len(lower)
        for k in range(n):
            self.face(lower[k], lower[(k + 1) % n], upper[(k + 1) % n], upper[k])

    def cone(self, ring, apex):
        for k in range(len(ring)):
            self.face(ring[k], ring[(k + 1) % len(ring)], apex)

    def gabled_opening(self, quad, gable):
        """A wall (bottom left, bottom right, top right, top left, seen from outside) less a gable (bottom left,
        bottom right, right eave, apex, left eave) that stands on its lower edge."""
        (a, b, c, d), (p, q, right, apex, left) = quad, gable
        if a != p:
            self.face(a, p, left, d)
        else:
            self.face(a, left, d)
        self.face(d, left, apex)
        self.face(d, apex, c)
        self.face(c, apex, right)
        if b != q:
            self.face(q, b, c, right)
        else:
            self.face(b, c, right)


def ring(n, radius, height, turn=0.0):
    """n points about the y axis, counter-clockwise seen from above, the first towards +z."""
    angles = [2 * math.pi * (k + turn) / n for k in range(n)]
    return [(radius * math.sin(a), height, radius * math.cos(a)) for a in angles]


def mixed():
    """A chapel: a tower (square, then octagonal) at the west (-x), a nave with a polygonal apse, a porch (+z)."""
    b = Builder()
    tower, top, eave, ridge = 1.6, 6.0, 3.0, 4.4
    nave = 1.2  # half the width of the nave
    # Tower: the wall towards the nave has an opening in the shape of the nave's section.
    corners = [(-tower, tower), (tower, tower), (tower, -tower), (-tower, -tower)]

    def low(k):
        return (corners[k % 4][0], 0.0, corners[k % 4][1])

    def high(k):
        return (corners[k % 4][0], top, corners[k % 4][1])

    for k in (0, 2, 3):
        b.face(low(k), low(k + 1), high(k + 1), high(k))
    west = [(tower, 0, nave), (tower, 0, -nave), (tower, eave, -nave), (tower, ridge, 0), (tower, eave, nave)]
    b.gabled_opening((low(1), low(2), high(2), high(1)), west)
    b.face(low(3), low(2), west[1], west[0], low(1), low(0))
    # Broaches from the square to the octagon, belfry, cornice, spire with a flat top.
    belfry = ring(8, 1.5, 6.8, 0.5 - 1.0)
    for k in range(4):
        # Octagon corners 2k and 2k + 1 stand over the side from corner k to corner k + 1.
        b.face(high(k), high(k + 1), belfry[2 * k + 1], belfry[2 * k])
        b.face(high(k), belfry[2 * k], belfry[(2 * k - 1) % 8])
    rings = [belfry, ring(8, 1.5, 8.4, -0.5), ring(8, 1.75, 8.6, -0.5), ring(8, 0.25, 13.0, -0.5)]
    for lower, upper in zip(rings, rings[1:]):
        b.band(lower, upper)
    b.face(*rings[-1])
    # Nave and apse. The south wall (+z) has the opening of the porch.
    east = 8.0
    porch_x, porch, porch_eave, porch_ridge, porch_z = 4.6, 0.7, 1.6, 2.4, 2.6
    gate = [(porch_x - porch, 0, nave), (porch_x + porch, 0, nave), (porch_x + porch, porch_eave, nave)]
    gate += [(porch_x, porch_ridge, nave), (porch_x - porch, porch_eave, nave)]
    south = [(tower, 0, nave), (east, 0, nave), (east, eave, nave), (tower, eave, nave)]
    north = [(east, 0, -nave), (tower, 0, -nave), (tower, eave, -nave), (east, eave, -nave)]
    b.gabled_opening(south, gate)
    b.face(*north)
    b.face((tower, eave, nave), (east, eave, nave), (east, ridge, 0), (tower, ridge, 0))
    b.face((east, eave, -nave), (tower, eave, -nave), (tower, ridge, 0), (east, ridge, 0))
    apse = [math.pi * k / 4 for k in range(5)]
    ground = [(east + nave * math.sin(a), 0.0, nave * math.cos(a)) for a in apse]
    eaves = [(x, eave, z) for x, _, z in ground]
    for k in range(4):
        b.face(ground[k], ground[k + 1], eaves[k + 1], eaves[k])
        b.face(eaves[k], eaves[k + 1], (east, ridge, 0))
    b.face(*reversed([(tower, 0, -nave), (tower, 0, nave), gate[0], gate[1], *ground]))
    # Porch.
    front = [(x, y, porch_z) for x, y, _ in gate]
    b.face(*front)
    b.face(gate[0], front[0], front[4], gate[4])
    b.face(front[1], gate[1], gate[2], front[2])
    b.face(front[4], front[3], gate[3], gate[4])
    b.face(front[3], front[2], gate[2], gate[3])
    b.face(gate[0], gate[1], front[1], front[0])
    comment = "A chapel of triangles, quads, a pentagon, a hexagon, an octagon and a 9-gon; closed. Metres, y is up."
    obj.write("mixed.obj", comment, b.vertices, b.faces)


def thin():
    """A hexagonal column of ever lower bands, a needle on it, and a ruler beside it."""
    b = Builder()
    radius = 1.0
    heights = [-1.0, 0.0, 0.1, 0.11, 0.111, 0.112, 0.122, 0.222, 1.222]
    rings = [ring(6, radius, y) for y in heights]
    b.face(*reversed(rings[0]))
    for lower, upper in zip(rings, rings[1:]):
        b.band(lower, upper)
    # The needle: twelve long faces whose lower side is 0.01 wide.
    collar = ring(6, 0.01, heights[-1])
    b.band(rings[-1], collar)
    middle = ring(6, 0.005, heights[-1] + 5.0)
    b.band(collar, middle)
    b.cone(middle, (0.0, heights[-1] + 10.0, 0.0))
    # The ruler: 10 long, 0.1 wide, 0.01 thick, with pointed ends (hexagons).
    outline = [(2.0, -5.0), (2.1, -4.9), (2.1, 4.9), (2.0, 5.0), (1.9, 4.9), (1.9, -4.9)]
    lower = [(x, -0.005, z) for x, z in reversed(outline)]
    upper = [(x, 0.005, z) for x, z in reversed(outline)]
    b.band(lower, upper)
    b.face(*upper)
    b.face(*reversed(lower))
    comment = "Thin triangles, quads and hexagons with an aspect up to 1000; two closed parts."
    obj.write("thin.obj", comment, b.vertices, b.faces)


def open_sheet():
    """A wavy sheet of quads and triangles with five holes and a bitten outline; with texture coordinates."""
    nx, nz = 16, 12
    cells = {(i, j) for i in range(nx) for j in range(nz)}
    cells -= {(i, j) for i in (3, 4) for j in (3, 4)}  # a square hole
    cells -= {(8, 2), (9, 2), (10, 2), (10, 3)}  # a bent one
    cells -= {(7, 7), (8, 7), (6, 8), (7, 8), (8, 8), (9, 8), (7, 9), (8, 9)}  # a cross-like one
    cells -= {(13, 5)}  # a single cell
    cells -= {(i, j) for i in range(12, nx) for j in range(9, nz)}  # a corner bitten off
    cells -= {(0, 9), (1, 9), (0, 10), (1, 10)}  # a bay in the side
    triangle_hole = (4, 8)  # half of this cell is missing
    vertices, uvs, index, faces = [], [], {}, []

    def vertex(i, j):
        if (i, j) not in index:
            index[i, j] = len(vertices)
            u, v = i / nx, j / nz
            x, z = 4.0 * (u - 0.5), 3.0 * (0.5 - v)
            y = 0.25 * math.sin(2.2 * x + 0.6) * math.cos(1.7 * z) + 0.12 * x * z / 3.0
            vertices.append((x, y, z))
            uvs.append((u, v))
        return index[i, j]

    for i, j in sorted(cells, key=lambda cell: (cell[1], cell[0])):
        a, b, c, d = vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)
        if (i, j) == triangle_hole:
            faces.append((a, b, c))
        elif (i * 7 + j * 3) % 5 == 0:
            faces += [(a, b, d), (b, c, d)]
        elif (i * 5 + j * 11) % 7 == 0:
            faces += [(a, b, c), (a, c, d)]
        else:
            faces.append((a, b, c, d))
    comment = "An open sheet of quads and triangles with a bitten outline and five holes. y is up."
    obj.write("open.obj", comment, vertices, faces, uvs=uvs, face_uvs=faces)


if __name__ == "__main__":
    cube()
    mixed()
    thin()
    open_sheet()
