"""Writes fox.obj: a standing fox of quads, closed, with vertex colours; made for subdivision.

    python3 scenes/make/fox.py

The right half (x >= 0) is modelled and mirrored. Rings of 12 run along the spine from the rump to the muzzle; legs,
tail, ears, eyes and nose are extruded from the faces between them. Decimetres; y is up, the fox looks to +z.
"""

import math

import obj

ORANGE, RUST, CREAM = (0.80, 0.33, 0.08), (0.62, 0.22, 0.05), (0.95, 0.90, 0.82)
SOCK, BLACK, TAN = (0.13, 0.08, 0.06), (0.02, 0.02, 0.02), (0.85, 0.55, 0.33)

# Angles of the seven vertices of half a ring, from the back to the belly, in degrees.
BODY_ANGLES = (90, 60, 30, 0, -34, -64, -90)
HEAD_ANGLES = (90, 66, 40, 12, -18, -55, -90)

# Rings: z, y of the middle, half height, half width, tilt of the normal (degrees upwards), squareness, angles.
RINGS = [
    (-2.95, 2.84, 0.46, 0.42, -8, 0.9, BODY_ANGLES),
    (-2.68, 2.74, 0.72, 0.66, -4, 0.9, BODY_ANGLES),
    (-2.15, 2.68, 0.84, 0.78, 0, 0.9, BODY_ANGLES),
    (-1.50, 2.68, 0.80, 0.76, 0, 0.9, BODY_ANGLES),
    (-0.75, 2.72, 0.73, 0.69, 0, 0.9, BODY_ANGLES),
    (0.00, 2.72, 0.78, 0.72, 0, 0.9, BODY_ANGLES),
    (0.62, 2.70, 0.90, 0.76, 4, 0.9, BODY_ANGLES),
    (1.20, 2.74, 0.96, 0.77, 8, 0.9, BODY_ANGLES),
    (1.70, 2.92, 0.96, 0.72, 24, 0.9, BODY_ANGLES),
    (2.08, 3.34, 0.84, 0.66, 42, 0.9, BODY_ANGLES),
    (2.36, 3.84, 0.72, 0.62, 44, 0.9, HEAD_ANGLES),
    (2.66, 4.26, 0.68, 0.74, 22, 0.9, HEAD_ANGLES),
    (3.00, 4.40, 0.66, 1.00, 6, 0.9, HEAD_ANGLES),
    (3.44, 4.36, 0.56, 0.82, -4, 0.9, HEAD_ANGLES),
    (3.80, 4.22, 0.42, 0.48, -8, 0.9, HEAD_ANGLES),
    (4.16, 4.07, 0.27, 0.28, -8, 0.8, HEAD_ANGLES),
    (4.48, 3.98, 0.20, 0.19, -6, 0.8, HEAD_ANGLES),
]
HALF = 7


class Half:
    """Half a model: vertices with x >= 0, those with x = 0 lie on the plane of symmetry."""

    def __init__(self):
        self.vertices, self.colours, self.faces = [], [], []

    def vertex(self, point, colour):
        self.vertices.append(list(point))
        self.colours.append(colour)
        return len(self.vertices) - 1

    def face(self, *corners):
        self.faces.append(tuple(corners))
        return len(self.faces) - 1

    def extrude(self, numbers):
        """Lifts faces off: walls along their outline, none on the plane of symmetry. {old vertex: new vertex}."""
        edges = {edge for n in numbers for edge in zip(self.faces[n], self.faces[n][1:] + self.faces[n][:1])}
        lifted = {}
        for v in sorted({v for edge in edges for v in edge}):
            lifted[v] = self.vertex(self.vertices[v], self.colours[v])
        for a, b in sorted(edges):
            if (b, a) not in edges and (self.vertices[a][0] > 0 or self.vertices[b][0] > 0):
                self.face(a, b, lifted[b], lifted[a])
        for n in numbers:
            self.faces[n] = tuple(lifted[v] for v in self.faces[n])
        return lifted

    def pull(self, numbers, grid, targets, colour):
        """Extrudes faces whose vertices are `grid` and moves those to `targets`; returns the new grid."""
        lifted = self.extrude(numbers)
        for v, point in zip(grid, targets):
            self.vertices[lifted[v]] = list(point)
            self.colours[lifted[v]] = colour
        return [lifted[v] for v in grid]

    def inset(self, number, amount, depth, colour):
        """A smaller copy of a face inside it, moved inwards by depth along the normal; returns its vertices."""
        corners = self.faces[number]
        points = [self.vertices[v] for v in corners]
        middle = [sum(axis) / len(points) for axis in zip(*points)]
        p, q = ([a - b for a, b in zip(points[k + 2], points[k])] for k in (0, 1))
        normal = [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
        length = math.sqrt(sum(n * n for n in normal))
        targets = [
            [m + (a - m) * amount - depth * n / length for a, m, n in zip(point, middle, normal)] for point in points
        ]
        return self.pull([number], corners, targets, colour)

    def mirrored(self):
        """(vertices, colours, faces) of the whole; vertices that no face uses are left out."""
        used = sorted({v for face in self.faces for v in face})
        right, left, vertices, colours = {}, {}, [], []
        for v in used:
            x, y, z = self.vertices[v]
            right[v] = len(vertices)
            vertices.append((x, y, z))
            colours.append(self.colours[v])
            left[v] = right[v]
            if x > 0:
                left[v] = len(vertices)
                vertices.append((-x, y, z))
                colours.append(self.colours[v])
        faces = [tuple(right[v] for v in face) for face in self.faces]
        faces += [tuple(left[v] for v in reversed(face)) for face in self.faces]
        return vertices, colours, faces


def ring_points(z, y, height, width, tilt, squareness, angles):
    """Half a ring from the top to the bottom."""
    tilt = math.radians(tilt)
    points = []
    for angle in angles:
        c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        across = 0.0 if abs(angle) == 90 else width * abs(c) ** squareness
        along = height * math.copysign(abs(s) ** squareness, s)
        points.append((across, y + along * math.cos(tilt), z - along * math.sin(tilt)))
    return points


def spine_colour(ring, k):
    """Colour of a vertex of the spine rings."""
    if ring >= 14:
        return CREAM if k >= 3 else ORANGE
    if ring >= 11:
        return CREAM if k >= 4 else ORANGE
    if ring >= 7:
        return CREAM if k >= 5 else ORANGE
    if k == 0:
        return RUST
    return CREAM if k == 6 and 2 <= ring else ORANGE


def leg(model, numbers, grid, sections):
    """A leg from two by two faces; grid: three rows of three from the outer side to the inner, rear to front.
    Sections: x, y, z of the middle, half width, half depth, forward lean of the section, colour."""
    for x, y, z, width, depth, lean, colour in sections:
        targets = []
        for i in (-1, 0, 1):
            for j in (1, 0, -1):
                corner = 0.80 if i and j else 1.0
                targets.append((x + j * width * corner, y + i * depth * lean, z + i * depth * corner))
        grid = model.pull(numbers, grid, targets, colour)


def build():
    model = Half()
    rings = [
        [model.vertex(p, spine_colour(r, k)) for k, p in enumerate(ring_points(*ring))]
        for r, ring in enumerate(RINGS)
    ]
    band = [
        [model.face(rings[r][k], rings[r + 1][k], rings[r + 1][k + 1], rings[r][k + 1]) for k in range(HALF - 1)]
        for r in range(len(RINGS) - 1)
    ]

    def cap(ring, forward):
        """Closes an end with 2 x 4 quads; the three vertices on the plane of symmetry, and the faces, from above."""
        top, bottom = model.vertices[ring[0]], model.vertices[ring[6]]
        middle = [
            model.vertex([0.0] + [t + (b - t) * f for t, b in zip(top[1:], bottom[1:])], model.colours[ring[k]])
            for k, f in ((2, 0.25), (3, 0.5), (4, 0.75))
        ]
        inner = [ring[0], *middle, ring[6]]
        faces = []
        for k in range(4):
            corners = (inner[k], inner[k + 1], ring[k + 2], ring[k + 1])
            faces.append(model.face(*(corners if forward else reversed(corners))))
        return middle, faces

    # Tail: half rings of five vertices about a curve, from the upper half of the rump.
    middle, faces = cap(rings[0], False)
    r = rings[0]
    grid = [r[0], r[1], r[2], r[3], middle[1], middle[0]]
    tail = [
        (-3.20, 2.94, 0.28, 0.28, 14, ORANGE),
        (-3.70, 2.76, 0.36, 0.38, 34, ORANGE),
        (-4.25, 2.36, 0.52, 0.54, 36, ORANGE),
        (-4.85, 1.98, 0.64, 0.64, 26, ORANGE),
        (-5.50, 1.74, 0.62, 0.60, 12, RUST),
        (-6.06, 1.68, 0.46, 0.46, -2, CREAM),
        (-6.50, 1.76, 0.20, 0.20, -16, CREAM),
    ]
    for z, y, height, width, tilt, colour in tail:
        points = ring_points(z, y, height, width, tilt, 1.0, (90, 45, 0, -45, -90))
        grid = model.pull(faces[:2], grid, [*points, (0.0, y, z - 0.03)], colour)

    # Hind legs: thigh, knee, hock (backwards), foot. Front legs: straight.
    def region(first, ks):
        numbers = [band[b][k] for b in (first, first + 1) for k in ks]
        return numbers, [rings[first + i][k] for i in range(3) for k in (ks[0], ks[0] + 1, ks[0] + 2)]

    hind = [
        (0.60, 1.74, -2.04, 0.24, 0.50, -0.10, ORANGE),
        (0.59, 1.40, -2.04, 0.20, 0.38, -0.30, ORANGE),
        (0.57, 1.06, -2.26, 0.16, 0.25, -0.45, RUST),
        (0.55, 0.78, -2.42, 0.14, 0.18, -0.20, SOCK),
        (0.55, 0.36, -2.30, 0.14, 0.17, 0.10, SOCK),
        (0.56, 0.18, -2.18, 0.18, 0.28, -0.15, SOCK),
        (0.56, 0.00, -2.14, 0.17, 0.29, 0.0, SOCK),
    ]
    leg(model, *region(1, (3, 4)), hind)
    front = [
        (0.57, 1.68, 1.04, 0.22, 0.36, 0.12, ORANGE),
        (0.54, 1.34, 1.00, 0.18, 0.27, 0.10, ORANGE),
        (0.51, 0.96, 1.02, 0.15, 0.20, 0.0, SOCK),
        (0.49, 0.42, 1.06, 0.14, 0.17, 0.0, SOCK),
        (0.50, 0.20, 1.16, 0.18, 0.26, -0.15, SOCK),
        (0.50, 0.00, 1.20, 0.17, 0.28, 0.0, SOCK),
    ]
    leg(model, *region(6, (3, 4)), front)

    # Ears: from two faces on top of the head, hollow in front.
    numbers = [band[11][1], band[11][2]]
    grid = [rings[11 + i][k] for i in (0, 1) for k in (1, 2, 3)]
    ears = [
        (0.72, 4.98, 2.84, 0.31, 0.17, 36, 0.04, ORANGE),
        (0.79, 5.28, 2.82, 0.28, 0.12, 28, 0.15, ORANGE),
        (0.87, 5.60, 2.80, 0.17, 0.08, 22, 0.08, SOCK),
        (0.92, 5.86, 2.78, 0.04, 0.035, 20, 0.00, SOCK),
    ]
    for x, y, z, width, depth, slant, hollow, colour in ears:
        c, s = math.cos(math.radians(slant)), math.sin(math.radians(slant))
        targets = []
        for i in (-1, 1):
            for j in (-1, 0, 1):
                back = hollow if i == 1 and j == 0 else 0.0
                bulge = 0.04 if j == 0 else 0.0
                targets.append((x + j * width * c, y - j * width * s, z + i * depth - back - bulge * (i == -1)))
        grid = model.pull(numbers, grid, targets, colour)
        model.colours[grid[4]] = CREAM if colour == ORANGE else TAN

    # Eyes and nose.
    model.inset(band[13][2], 0.50, -0.03, BLACK)
    middle, faces = cap(rings[-1], True)
    r = rings[-1]
    nose = [r[0], r[1], r[2], r[3], middle[1], middle[0]]
    points = ring_points(4.60, 4.07, 0.12, 0.13, -6, 0.8, (90, 45, 0, -45, -90))
    model.pull(faces[:2], nose, [*points, (0.0, 4.07, 4.65)], BLACK)
    return model


if __name__ == "__main__":
    vertices, colours, faces = build().mirrored()
    comment = "A standing fox of quads, closed, with vertex colours. Decimetres; y is up, it looks to +z."
    obj.write("fox.obj", comment, vertices, faces, colours=colours)
