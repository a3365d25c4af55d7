"""Writes clay.png, chrome.png and pearl.png: a lit sphere each, 256 x 256, that fills the picture.

    python3 scenes/make/matcaps.py

A matcap gives the colour of a surface by its normal in view space: x to the right, y up, z towards the eye. Around the disk the colour
of its rim goes on, so that filtering finds no edge.
"""

import math
import struct
import zlib

import obj
from cage import add, dot, times, unit

SIZE = 256
SAMPLES = 3  # a side of a pixel


def write_png(name, size, pixel):
    """`pixel(x, y)`: linear (r, g, b) at a point of the picture, both from 0 to `size`, y downwards."""

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    rows = bytearray()
    for j in range(size):
        row = bytearray()
        for i in range(size):
            total = (0.0, 0.0, 0.0)
            for k in range(SAMPLES * SAMPLES):
                dx, dy = (k % SAMPLES + 0.5) / SAMPLES, (k // SAMPLES + 0.5) / SAMPLES
                total = add(total, pixel(i + dx, j + dy))
            row += bytes(encode(c / SAMPLES**2) for c in total)
        rows.append(1)  # filter "sub"
        rows += bytes((b - (row[i - 3] if i >= 3 else 0)) & 255 for i, b in enumerate(row))
    header = struct.pack(">IIBBBBB", size, size, 8, 2, 0, 0, 0)
    data = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(bytes(rows), 9))
    (obj.SCENES / name).write_bytes(data + chunk(b"IEND", b""))


def encode(linear):
    """sRGB of a linear value, as a byte."""
    c = min(max(linear, 0.0), 1.0)
    c = 12.92 * c if c <= 0.0031308 else 1.055 * c ** (1 / 2.4) - 0.055
    return int(255 * c + 0.5)


def normal_at(x, y):
    """The normal that is seen at a point of the picture; beyond the rim, that of the rim."""
    u, v = 2 * x / SIZE - 1, 1 - 2 * y / SIZE
    r = math.hypot(u, v)
    if r > 0.999:
        u, v = 0.999 * u / r, 0.999 * v / r
    return (u, v, math.sqrt(max(0.0, 1 - u * u - v * v)))


def smooth(a, b, x):
    t = min(max((x - a) / (b - a), 0.0), 1.0)
    return t * t * (3 - 2 * t)


def mix(a, b, t):
    return add(times(1 - t, a), times(t, b))


def lambert(n, direction, wrap=0.0):
    return max(0.0, (dot(n, unit(direction)) + wrap) / (1 + wrap))


def gloss(n, direction, power):
    """Blinn's highlight, seen along -z."""
    half = unit(add(unit(direction), (0, 0, 1)))
    return max(0.0, dot(n, half)) ** power


KEY, FILL, BACK = (-0.5, 0.75, 0.6), (0.9, 0.1, 0.45), (0.35, 0.45, -0.9)


def clay(n):
    """Warm and matt: a soft key light, sky from above, light bounced from below, a rim."""
    colour = (0.52, 0.235, 0.135)
    light = add(times(1.05 * lambert(n, KEY, 0.25), (1.0, 0.93, 0.82)), times(0.22 * lambert(n, FILL, 0.4), (0.75, 0.85, 1.0)))
    light = add(light, mix((0.10, 0.065, 0.05), (0.15, 0.18, 0.24), 0.5 + 0.5 * n[1]))
    rim = smooth(0.55, 1.0, 1 - n[2]) * lambert(n, BACK, 0.6)
    shaded = tuple(a * b for a, b in zip(colour, light))
    return add(add(shaded, times(0.25 * rim, (1.0, 0.75, 0.55))), times(0.05 * gloss(n, KEY, 18), (1.0, 0.95, 0.9)))


def chrome(n):
    """A mirror in a studio: dark floor, a bright horizon, a sky that darkens upwards, two soft boxes."""
    r = add(times(2 * n[2], n), (0, 0, -1))  # the eye looks along -z
    height = r[1]
    sky = mix((0.62, 0.70, 0.78), (0.06, 0.10, 0.19), smooth(0.0, 0.95, height))
    floor = mix((0.16, 0.135, 0.115), (0.025, 0.022, 0.022), smooth(0.0, 0.75, -height))
    colour = mix(floor, sky, smooth(-0.035, 0.035, height))
    colour = add(colour, times(0.55 * math.exp(-((height / 0.07) ** 2)), (1.0, 0.96, 0.88)))
    for direction, width, softness, strength in [((-0.72, 0.55, 0.42), 0.24, 0.07, 1.15), ((0.85, 0.28, 0.2), 0.13, 0.05, 0.75)]:
        away = math.acos(min(1.0, max(-1.0, dot(unit(r), unit(direction)))))
        colour = add(colour, times(strength * (1 - smooth(width - softness, width + softness, away)), (1.0, 0.98, 0.95)))
    return times(0.55 + 0.45 * smooth(0.0, 0.35, n[2]), colour)


def pearl(n):
    """White with colours that change with the angle, a broad highlight and a small one."""
    facing = n[2]
    # Interference: the phase grows with the path through a thin layer.
    phase = 2 * math.pi * (1.15 + 1.1 * facing + 0.12 * n[1])
    sheen = tuple(0.5 + 0.5 * math.cos(phase - shift) for shift in (0.0, 2.1, 4.2))
    base = mix((0.60, 0.555, 0.54), sheen, 0.16 + 0.14 * (1 - facing))
    light = 0.80 * lambert(n, KEY, 0.5) + 0.16 * lambert(n, FILL, 0.6) + 0.17 + 0.09 * n[1]
    colour = times(light, base)
    colour = add(colour, times(0.20 * gloss(n, KEY, 12), (1.0, 0.97, 0.95)))
    colour = add(colour, times(0.50 * gloss(n, KEY, 120), (1.0, 1.0, 1.0)))
    return add(colour, times(0.22 * smooth(0.5, 1.0, 1 - facing) * lambert(n, BACK, 0.8), (0.80, 0.86, 1.0)))


if __name__ == "__main__":
    for name, shade in [("clay", clay), ("chrome", chrome), ("pearl", pearl)]:
        write_png(f"{name}.png", SIZE, lambda x, y, shade=shade: shade(normal_at(x, y)))
