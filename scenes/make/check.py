"""Checks every scenes/*.obj of polygons: indices, winding, closedness, degenerate faces, orientation. Exit code 1 if any fails.

    python3 scenes/make/check.py

Closed files: every edge used exactly twice, in opposite directions, and the enclosed volume of every connected part
is positive, so that counter-clockwise faces look outwards. open.obj: every edge at most once in each direction.
Printed: faces by number of corners, boundary loops, the largest aspect (longest side over width), volume.
"""

import collections
import math
import sys

import obj

OPEN = {"open.obj", "petal.obj"}
SMALLEST_AREA = 1e-9
LEAST_PLANARITY = 0.5  # cosine between a corner's normal and the face's: below it, the face folds over


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def area_vector(points):
    """Newell's method: normal times area of a polygon."""
    total = (0.0, 0.0, 0.0)
    for k in range(1, len(points) - 1):
        part = cross(minus(points[k], points[0]), minus(points[k + 1], points[0]))
        total = tuple(x + y / 2 for x, y in zip(total, part))
    return total


def corner_faults(name, number, points):
    """A corner whose normal turns away from that of the face: concave, or folded."""
    area = area_vector(points)
    size = math.sqrt(dot(area, area))
    if size < SMALLEST_AREA:
        yield f"{name}: face {number} has no area"
        return
    for k, point in enumerate(points):
        before, after = minus(point, points[k - 1]), minus(points[(k + 1) % len(points)], point)
        turn = cross(before, after)
        length = math.sqrt(dot(turn, turn))
        if length < 1e-9 * math.sqrt(dot(before, before) * dot(after, after)):
            if dot(before, after) <= 0:
                yield f"{name}: face {number} turns back at corner {k}"
        elif dot(turn, area) < LEAST_PLANARITY * length * size:
            yield f"{name}: face {number} is concave or bent at corner {k}: {dot(turn, area) / (length * size):.2f}"


def components(faces):
    """Groups of faces that share vertices."""
    parent = {}

    def find(v):
        while parent.setdefault(v, v) != v:
            parent[v] = parent[parent[v]]
            v = parent[v]
        return v

    for face in faces:
        for v in face[1:]:
            parent[find(v)] = find(face[0])
    groups = collections.defaultdict(list)
    for face in faces:
        groups[find(face[0])].append(face)
    return list(groups.values())


def boundary_loops(edges):
    """Number of closed loops of the boundary; a vertex where two loops meet is a fault."""
    onward = {}
    for a, b in edges:
        if (b, a) not in edges:
            if a in onward:
                raise ValueError(f"two boundaries meet at vertex {a + 1}")
            onward[a] = b
    loops = 0
    while onward:
        start = next(iter(onward))
        at = onward.pop(start)
        while at != start:
            at = onward.pop(at)
        loops += 1
    return loops


def fans(faces):
    """Vertices whose faces are not one fan: each vertex's corners are joined through its edges."""
    around = collections.defaultdict(list)
    for face in faces:
        for k, v in enumerate(face):
            around[v].append((face[k - 1], face[(k + 1) % len(face)]))
    for v, wedges in around.items():
        onward = {after: before for before, after in wedges}
        starts = [after for after in onward if after not in set(onward.values())]
        at, steps = (starts or list(onward))[0], 0
        while at in onward and steps < len(wedges):
            at, steps = onward[at], steps + 1
        if len(starts) > 1 or steps < len(wedges):
            yield v


def check(path):
    name = path.name
    vertices, colours, uvs, faces, face_uvs = obj.read(path)
    faults = []
    edges = collections.Counter()
    aspect = 0.0
    for number, face in enumerate(faces, 1):
        if len(face) < 3 or len(set(face)) != len(face) or not all(0 <= v < len(vertices) for v in face):
            faults.append(f"{name}: face {number} has wrong indices")
            continue
        edges.update(zip(face, face[1:] + face[:1]))
        points = [vertices[v] for v in face]
        faults += corner_faults(name, number, points)
        area = area_vector(points)
        longest = max(math.dist(points[k], points[k - 1]) for k in range(len(points)))
        width = math.sqrt(dot(area, area)) / longest * (2 if len(face) == 3 else 1)
        aspect = max(aspect, longest / max(width, SMALLEST_AREA))
    faults += [f"{name}: edge {edge} is used {n} times in one direction" for edge, n in edges.items() if n > 1]
    faults += [f"{name}: the faces round vertex {v + 1} are not one fan" for v in fans(faces)]
    faults += [f"{name}: vertex {v + 1} is not used" for v in range(len(vertices)) if v not in {w for f in faces for w in f}]
    if len(set(vertices)) != len(vertices):
        faults.append(f"{name}: two vertices have the same position")
    if any(c is None for c in colours) != all(c is None for c in colours):
        faults.append(f"{name}: some vertices have a colour and some have none")
    if any(f and max(f) >= len(uvs) for f in face_uvs):
        faults.append(f"{name}: texture index out of range")
    loops = boundary_loops(edges)
    if (loops > 0) != (name in OPEN):
        faults.append(f"{name}: {loops} boundary loops")
    volumes = []
    for group in components(faces):
        origin = vertices[group[0][0]]
        volume = 0.0
        for face in group:
            points = [minus(vertices[v], origin) for v in face]
            volume += sum(dot(points[0], cross(points[k], points[k + 1])) for k in range(1, len(points) - 1)) / 6
        volumes.append(volume)
        if name not in OPEN and volume <= 0:
            faults.append(f"{name}: a part has the volume {volume}: its faces look inwards")
    kinds = collections.Counter(len(face) for face in faces)
    print(
        f"{name}: {len(vertices)} vertices, {len(faces)} faces ("
        + ", ".join(f"{n} x {k}-gon" for k, n in sorted(kinds.items()))
        + f"), {loops} boundary loops, {len(volumes)} parts, aspect up to {aspect:.0f}, volume "
        + ", ".join(f"{v:.4g}" for v in volumes)
    )
    return faults


def main():
    meshes = [path for path in sorted(obj.SCENES.glob("*.obj")) if "\nsurf " not in path.read_text(encoding="ascii")]
    faults = [fault for path in meshes for fault in check(path)]
    print("\n".join(faults) or "all well")
    sys.exit(bool(faults))


if __name__ == "__main__":
    main()
