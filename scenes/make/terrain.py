"""Writes scenes/jacksboro.png, the 16-bit height map of the scene terrain_real.ron.

    pip download --no-deps matplotlib
    python3 scenes/make/terrain.py matplotlib-*.whl

The input is matplotlib's wheel, or the file jacksboro_fault_dem.npz in it. Only Python's standard library is
used. Printed: the georeference and the extent in metres that terrain_real.ron states.

Samples: 403 columns (west to east) x 344 rows (north to south), 3 arc-seconds apart, whole metres. A sample of the
PNG is the height in metres above mean sea level, as it is: quantum 1 m, offset 0. There are no voids.
"""

import ast
import io
import math
import pathlib
import struct
import sys
import zipfile
import zlib

MEMBER = "matplotlib/mpl-data/sample_data/jacksboro_fault_dem.npz"
WGS84_A = 6378137.0
WGS84_E2 = 6.69437999014e-3
# Cross Mountain, Tennessee, 1,077 m: 36 deg 11' 54" N, 84 deg 13' 50" W. The check of the picture's orientation.
SUMMIT = (36.19833, -84.23056)


def read_npy(data):
    """(shape, flat tuple of numbers) of a little-endian .npy file (format versions 1 to 3)."""
    if data[:6] != b"\x93NUMPY":
        raise ValueError("not an .npy file")
    length_format = "<H" if data[6] == 1 else "<I"
    length = struct.unpack_from(length_format, data, 8)[0]
    start = 8 + struct.calcsize(length_format)
    header = ast.literal_eval(data[start : start + length].decode("ascii"))
    code = {"<i2": "h", "<f8": "d"}[header["descr"]]
    if header["fortran_order"]:
        raise ValueError("column-major arrays are not read")
    count = math.prod(header["shape"])
    return header["shape"], struct.unpack_from(f"<{count}{code}", data, start + length)


def read_npz(path):
    """{name: (shape, numbers)} of an .npz file, or of the sample file in a wheel of matplotlib."""
    raw = pathlib.Path(path).read_bytes()
    with zipfile.ZipFile(io.BytesIO(raw)) as archive:
        if MEMBER in archive.namelist():
            raw = archive.read(MEMBER)
    with zipfile.ZipFile(io.BytesIO(raw)) as archive:
        return {name[:-4]: read_npy(archive.read(name)) for name in archive.namelist()}


def write_png16(path, width, height, samples):
    """A greyscale PNG of 16 bits a sample; samples in rows from the top."""

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    rows = bytearray()
    for j in range(height):
        row = struct.pack(f">{width}H", *samples[j * width : (j + 1) * width])
        rows.append(1)  # filter "sub": the difference from the sample to the left, byte by byte
        rows += bytes((b - (row[i - 2] if i >= 2 else 0)) & 255 for i, b in enumerate(row))
    header = struct.pack(">IIBBBBB", width, height, 16, 0, 0, 0, 0)
    data = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(bytes(rows), 9))
    pathlib.Path(path).write_bytes(data + chunk(b"IEND", b""))


def metres_per_degree(latitude):
    """(of latitude, of longitude) on the WGS 84 ellipsoid at a latitude in degrees."""
    phi = math.radians(latitude)
    w = 1.0 - WGS84_E2 * math.sin(phi) ** 2
    meridian = WGS84_A * (1.0 - WGS84_E2) / w**1.5
    parallel = WGS84_A / math.sqrt(w) * math.cos(phi)
    return math.radians(meridian), math.radians(parallel)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    source = read_npz(sys.argv[1])
    (rows, columns), heights = source["elevation"]
    west, east, dx, dy = (source[name][1][0] for name in ("xmin", "xmax", "dx", "dy"))
    # The file's ymax is the northern edge, of row 0. Its ymin is not used: it was made with the wrong sign of dy,
    # lies north of ymax, and would put the summit 32 km away from where it is.
    north = source["ymax"][1][0]
    south = north - rows * dy
    if abs(east - west - columns * dx) > 1e-9:
        raise ValueError("the georeference is not the one that this script was written for")
    if not all(0 < h < 65535 for h in heights):
        raise ValueError("a height does not fit 16 bits without sign")
    target = pathlib.Path(__file__).resolve().parent.parent / "jacksboro.png"
    write_png16(target, columns, rows, heights)

    # The stated edges are those of the cells; samples lie half a cell inside.
    summit = max(range(len(heights)), key=lambda k: heights[k])
    summit_row, summit_column = divmod(summit, columns)
    summit_north, summit_east = north - (summit_row + 0.5) * dy, west + (summit_column + 0.5) * dx
    if math.hypot(summit_north - SUMMIT[0], summit_east - SUMMIT[1]) > dx:
        raise ValueError("the highest sample is not where Cross Mountain is: mirrored, flipped, or another region")
    latitude = (north + south) / 2.0
    per_latitude, per_longitude = metres_per_degree(latitude)
    print(f"{target.name}: {columns} x {rows} samples, {min(heights)} to {max(heights)} m")
    print(f"first sample (north-west): {north - dy / 2:.6f} N, {west + dx / 2:.6f} E; spacing {dx * 3600:.3f} arc-seconds")
    print(f"summit: sample ({summit_column}, {summit_row}) from the north-west, {heights[summit]} m, {summit_north:.5f} N, {summit_east:.5f} E")
    print(f"spacing: {dx * per_longitude:.3f} m east, {dy * per_latitude:.3f} m north (at {latitude:.4f} N)")
    print(f"extent first to last sample: {(columns - 1) * dx * per_longitude:.1f} m x {(rows - 1) * dy * per_latitude:.1f} m")


if __name__ == "__main__":
    main()
