"""Writes free-form surfaces: NURBS as Wavefront OBJ, Bézier patches as .bpt. Numbers are exact: shared points stay shared."""

import pathlib

SCENES = pathlib.Path(__file__).resolve().parent.parent


def number(value):
    """The shortest text that reads back as the same number."""
    text = repr(float(value) + 0.0)
    return text[:-2] if text.endswith(".0") else text


def write_obj(name, comment, surfaces):
    """surfaces: (name, (p, q), knots in u, knots in v, rows of (x, y, z, w)), u along the rows."""
    lines = [f"# {line}" for line in comment.splitlines()]
    first = 1
    for title, degree, knots_u, knots_v, rows in surfaces:
        points = [point for row in rows for point in row]
        assert len(knots_u) == len(rows[0]) + degree[0] + 1 and len(knots_v) == len(rows) + degree[1] + 1
        lines.append(f"o {title}")
        lines += ["v " + " ".join(map(number, point)) for point in points]
        rational = "rat " if any(point[3] != 1 for point in points) else ""
        lines.append(f"cstype {rational}bspline")
        lines.append(f"deg {degree[0]} {degree[1]}")
        ends = [knots_u[degree[0]], knots_u[-degree[0] - 1], knots_v[degree[1]], knots_v[-degree[1] - 1]]
        controls = [str(first + k) for k in range(len(points))]
        lines.append("surf " + " ".join(list(map(number, ends)) + controls))
        lines.append("parm u " + " ".join(map(number, knots_u)))
        lines.append("parm v " + " ".join(map(number, knots_v)))
        lines.append("end")
        first += len(points)
    (SCENES / name).write_text("\n".join(lines) + "\n", encoding="ascii")


def write_bpt(name, patches):
    """patches: four rows of four points (x, y, z) each."""
    lines = [str(len(patches))]
    for rows in patches:
        lines.append(f"{len(rows[0]) - 1} {len(rows) - 1}")
        lines += [" ".join(map(number, point)) for row in rows for point in row]
    (SCENES / name).write_text("\n".join(lines) + "\n", encoding="ascii")


def clamped(inner, degree):
    """A clamped knot vector of distinct ascending parameters."""
    return [inner[0]] * degree + list(inner) + [inner[-1]] * degree
