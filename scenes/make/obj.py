"""Writes and reads the subset of Wavefront OBJ that the scenes use: v (with colours), vt, f, and tags of creases."""

import pathlib

SCENES = pathlib.Path(__file__).resolve().parent.parent


def number(value):
    """The shortest text of a number with at most six decimals."""
    text = f"{value:.6f}".rstrip("0").rstrip(".")
    return "0" if text in ("", "-0") else text


def write(name, comment, vertices, faces, colours=None, uvs=None, face_uvs=None, creases=()):
    """vertices: (x, y, z); faces: tuples of 0-based indices; colours: one (r, g, b) a vertex, 0 to 1;
    uvs: (u, v), with face_uvs: one tuple of 0-based indices a face; creases: (a, b, sharpness)."""
    lines = [f"# {line}" for line in comment.splitlines()]
    for k, vertex in enumerate(vertices):
        colour = colours[k] if colours else ()
        lines.append("v " + " ".join(number(value) for value in (*vertex, *colour)))
    for uv in uvs or ():
        lines.append("vt " + " ".join(number(value) for value in uv))
    for k, face in enumerate(faces):
        if face_uvs:
            corners = (f"{v + 1}/{t + 1}" for v, t in zip(face, face_uvs[k]))
        else:
            corners = (str(v + 1) for v in face)
        lines.append("f " + " ".join(corners))
    # The vertices of tags count from 0.
    lines += [f"t crease 2/1/0 {a} {b} {number(sharpness)}" for a, b, sharpness in creases]
    (SCENES / name).write_text("\n".join(lines) + "\n", encoding="ascii")


def read(path):
    """(vertices, colours, uvs, faces, face_uvs) of a file; colours and face_uvs hold None where there is none."""
    vertices, colours, uvs, faces, face_uvs = [], [], [], [], []
    for line in pathlib.Path(path).read_text(encoding="ascii").splitlines():
        word, *rest = line.split() or ["#"]
        if word == "v":
            values = [float(text) for text in rest]
            vertices.append(tuple(values[:3]))
            colours.append(tuple(values[3:]) or None)
        elif word == "vt":
            uvs.append(tuple(float(text) for text in rest))
        elif word == "f":
            corners = [text.split("/") for text in rest]
            faces.append(tuple(int(c[0]) - 1 for c in corners))
            face_uvs.append(tuple(int(c[1]) - 1 for c in corners) if len(corners[0]) > 1 else None)
        elif word not in ("#", "t"):
            raise ValueError(f"{path}: unexpected line {line!r}")
    return vertices, colours, uvs, faces, face_uvs
