#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Anneal6D authors
"""Makes the models beside this file: measuring_cup.obj, oil_can.obj (with .mtl and .png) and
cube84.obj. Millimetres, y up. Needs Python's standard library only; the result is the same on every
machine.

    python3 make_models.py [FOLDER]
"""

import math
import struct
import sys
import zlib
from pathlib import Path

CREASE = math.cos(math.radians(40))
HEADER = ("# SPDX-License-Identifier: BSD-3-Clause\n"
          "# Copyright (c) 2026 The Anneal6D authors\n"
          "# Made by make_models.py. Millimetres, y up.\n")


# --- vectors -------------------------------------------------------------------------------------

def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def add(a, b):
    return tuple(x + y for x, y in zip(a, b))


def scale(a, s):
    return tuple(x * s for x in a)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    length = math.sqrt(dot(a, a))
    return scale(a, 1 / length) if length > 0 else a


def smooth_step(x):
    x = min(max(x, 0.0), 1.0)
    return x * x * (3 - 2 * x)


# --- meshes: triangles of corners (position, uv or None) -----------------------------------------

def grid(points, uvs=None, closed=True, flip=False):
    """Triangles between successive rings of equally many points; `closed` joins last to first. They
    face outward if the points run from x to z on the way along y, else with `flip`."""
    triangles = []
    for i in range(len(points) - 1):
        count = len(points[i])
        for j in range(count if closed else count - 1):
            k = (j + 1) % count
            quad = [(points[a][b], uvs[a][b] if uvs else None)
                    for a, b in ((i, j), (i, k), (i + 1, k), (i + 1, j))]
            if flip:
                quad.reverse()
            for triangle in ((quad[0], quad[2], quad[1]), (quad[0], quad[3], quad[2])):
                a, b, c = (corner[0] for corner in triangle)
                if max(abs(x) for x in cross(sub(b, a), sub(c, a))) > 1e-9:
                    triangles.append(triangle)
    return triangles


def write_obj(path, triangles, material=""):
    """Shading normals: angle-weighted mean of the adjacent faces that differ by less than 40
    degrees."""
    normals = [unit(cross(sub(b[0], a[0]), sub(c[0], a[0]))) for a, b, c in triangles]
    around = {}
    for index, triangle in enumerate(triangles):
        for k in range(3):
            here = triangle[k][0]
            to_next = unit(sub(triangle[(k + 1) % 3][0], here))
            to_previous = unit(sub(triangle[(k + 2) % 3][0], here))
            angle = math.acos(min(1.0, max(-1.0, dot(to_next, to_previous))))
            key = tuple(round(x, 4) for x in here)
            around.setdefault(key, []).append((index, angle))

    tables = {"v": {}, "vt": {}, "vn": {}}

    def index_of(keyword, values):
        text = " ".join(f"{x:.4f}".rstrip("0").rstrip(".") for x in values)
        text = " ".join("0" if word == "-0" else word for word in text.split())
        return tables[keyword].setdefault(text, len(tables[keyword]) + 1)

    faces = []
    for index, triangle in enumerate(triangles):
        corners = []
        for position, uv in triangle:
            key = tuple(round(x, 4) for x in position)
            total = (0.0, 0.0, 0.0)
            for other, angle in around[key]:
                if dot(normals[other], normals[index]) > CREASE:
                    total = add(total, scale(normals[other], angle))
            corners.append(f"{index_of('v', position)}/"
                           f"{index_of('vt', uv) if uv else ''}/{index_of('vn', unit(total))}")
        faces.append("f " + " ".join(corners))
    with open(path, "w", encoding="ascii", newline="\n") as file:
        file.write(HEADER + material)
        for keyword, table in tables.items():
            file.writelines(f"{keyword} {text}\n" for text in table)
        file.writelines(face + "\n" for face in faces)
    print(f"{path}: {len(faces)} triangles, {len(tables['v'])} points")


# --- the measuring cup ---------------------------------------------------------------------------

CUP_PROFILE = [  # radius, height: along the outside from below, over the rim, down the inside
    (0, 0), (31, 0), (34, 1), (35.5, 3.5), (38, 35), (40.5, 70), (42.8, 104), (44.2, 126),
    (46.5, 135), (47.0, 137.5), (46.2, 139.5), (44.6, 140), (43.4, 138.5), (41.8, 126),
    (40.4, 104), (33.2, 4.5), (0, 4.0)]


def cup_point(radius, height, angle):
    """A point of the cup; around the angle pi the rim is drawn out to a spout."""
    off = math.atan2(math.sin(angle - math.pi), math.cos(angle - math.pi))
    pull = math.exp(-(off / 0.30) ** 2) * smooth_step((height - 92) / 48)
    if radius > 0:
        radius += 15 * pull
    return (radius * math.cos(angle), height + 3 * pull, radius * math.sin(angle))


def handle():
    """A bow of rounded section whose ends lie within the wall."""
    steps, corners = 18, 10
    path = []
    for i in range(steps + 1):
        t = math.pi * (i / steps - 0.5)
        wall = 39.5 + 2.8 * math.sin(t)  # the middle of the wall at either end
        path.append((wall + 36 * abs(math.cos(t)) ** 0.8, 74 + 40 * math.sin(t), 0.0))
    rings = []
    for i, center in enumerate(path):
        along = unit(sub(path[min(i + 1, steps)], path[max(i - 1, 0)]))
        across = (0.0, 0.0, 1.0)
        outward = cross(along, across)
        ring = []
        for k in range(corners):
            a = 2 * math.pi * k / corners
            ring.append(add(center, add(scale(outward, 4.2 * math.cos(a)),
                                        scale(across, 8.5 * math.sin(a)))))
        rings.append(ring)
    return grid(rings)


def measuring_cup(folder):
    around = 40
    rings = [[cup_point(r, y, 2 * math.pi * k / around) for k in range(around)]
             for r, y in CUP_PROFILE]
    write_obj(folder / "measuring_cup.obj", grid(rings) + handle())


# --- the oil can ---------------------------------------------------------------------------------

CAN_PROFILE = [  # half width, half depth, height, roundness: from the bottom's middle to the cap's
    (0, 0, 1.5, 1), (38, 25, 0, 0.35), (43, 30, 0, 0.35), (45, 32, 2, 0.35), (45, 32, 30, 0.35),
    (44, 31, 60, 0.35), (44, 31, 100, 0.35), (45, 32, 130, 0.35), (45, 32, 158, 0.35),
    (43, 30.5, 166, 0.45), (36, 26, 176, 0.6), (26, 20, 184, 0.8), (17, 16, 189, 1),
    (14, 14, 191, 1), (14, 14, 197, 1), (17, 17, 197, 1), (17, 17, 214, 1), (15.5, 15.5, 216, 1),
    (0, 0, 216, 1)]


def outline(half_width, half_depth, roundness, count):
    """A rectangle with corners of a radius that is `roundness` times its smaller half side; points
    at equal shares of the circumference, from the middle of the front on, `count` and the first
    again."""
    radius = roundness * min(half_width, half_depth)
    flat_x, flat_z = half_width - radius, half_depth - radius
    quarter = math.pi / 2 * radius
    pieces = [flat_x, quarter, 2 * flat_z, quarter, 2 * flat_x, quarter, 2 * flat_z, quarter, flat_x]
    total = sum(pieces)

    def at(s):
        for number, length in enumerate(pieces):
            if s <= length or number == len(pieces) - 1:
                break
            s -= length
        if number % 2 == 0:
            side = number // 2 % 4
            along = s if number == 0 else s - (flat_z if side in (1, 3) else flat_x)
            return [(along, half_depth), (half_width, -along), (-along, -half_depth),
                    (-half_width, along)][side]
        corner = number // 2
        turn = corner * math.pi / 2 + (s / radius if radius > 0 else 0)
        middle = [(flat_x, flat_z), (flat_x, -flat_z), (-flat_x, -flat_z), (-flat_x, flat_z)][corner]
        return (middle[0] + radius * math.sin(turn), middle[1] + radius * math.cos(turn))

    return [at(total * k / count) if total > 0 else (0.0, 0.0) for k in range(count + 1)]


def oil_can(folder):
    around = 44
    lengths = [0.0]
    for a, b in zip(CAN_PROFILE, CAN_PROFILE[1:]):
        lengths.append(lengths[-1] + math.hypot(0.5 * (a[0] - b[0] + a[1] - b[1]), a[2] - b[2]))
    rings, uvs = [], []
    for (half_width, half_depth, height, roundness), length in zip(CAN_PROFILE, lengths):
        ring = [(x, float(height), z)
                for x, z in outline(half_width, half_depth, roundness, around)]
        ring[-1] = ring[0]
        rings.append(ring)
        uvs.append([(k / around, length / lengths[-1]) for k in range(around + 1)])
    material = "mtllib oil_can.mtl\nusemtl can\n"
    write_obj(folder / "oil_can.obj", grid(rings, uvs, closed=False, flip=True), material)
    (folder / "oil_can.mtl").write_text(HEADER + "newmtl can\nKd 1 1 1\nmap_Kd oil_can.png\n",
                                        encoding="ascii", newline="\n")
    marks = [length / lengths[-1] for length in lengths]
    write_png(folder / "oil_can.png", can_texture(marks))


# --- the oil can's label -------------------------------------------------------------------------

SIZE = 512
LETTERS = {  # five by seven
    "A": "01110 10001 10001 11111 10001 10001 10001",
    "E": "11111 10000 10000 11110 10000 10000 11111",
    "I": "01110 00100 00100 00100 00100 00100 01110",
    "L": "10000 10000 10000 10000 10000 10000 11111",
    "N": "10001 11001 10101 10101 10011 10001 10001",
    "O": "01110 10001 10001 10001 10001 10001 01110",
    "6": "01110 10000 10000 11110 10001 10001 01110",
    "D": "11110 10001 10001 10001 10001 10001 11110",
}


class Picture:
    """Rows of (r, g, b) from above; drawing wraps around sideways, as the label does."""

    def __init__(self, color):
        self.rows = [[color] * SIZE for _ in range(SIZE)]

    def box(self, x, y, width, height, color):
        for row in range(max(0, round(y)), min(SIZE, round(y + height))):
            for column in range(round(x), round(x + width)):
                self.rows[row][column % SIZE] = color

    def disc(self, x, y, radius_x, radius_y, color):
        for row in range(max(0, math.floor(y - radius_y)), min(SIZE, math.ceil(y + radius_y) + 1)):
            for column in range(math.floor(x - radius_x), math.ceil(x + radius_x) + 1):
                if ((column - x) / radius_x) ** 2 + ((row - y) / radius_y) ** 2 <= 1:
                    self.rows[row][column % SIZE] = color

    def text(self, x, y, dot_size, text, color):
        for letter in text:
            for row, line in enumerate(LETTERS.get(letter, " ".join(["00000"] * 7)).split()):
                for column, bit in enumerate(line):
                    if bit == "1":
                        self.box(x + column * dot_size, y + row * dot_size, dot_size, dot_size,
                                 color)
            x += 6 * dot_size


def can_texture(marks):
    """Front (middle of the label: column 0), right side (128), back (256), left side (384)."""
    green, dark, cream = (28, 112, 60), (16, 58, 36), (244, 232, 200)
    yellow, red, orange, white = (246, 200, 36), (196, 32, 38), (236, 120, 24), (250, 250, 246)

    def row(mark):  # v = 0 is the bottom of the texture
        return (1 - mark) * SIZE

    picture = Picture(green)
    top, bottom = row(marks[8]), row(marks[3])
    height = bottom - top
    picture.box(0, bottom, SIZE, SIZE - bottom, dark)                            # bottom
    picture.box(0, row(marks[14]), SIZE, row(marks[9]) - row(marks[14]), yellow)  # shoulder
    picture.box(0, 0, SIZE, row(marks[14]), red)                                 # cap
    for k in range(16):
        picture.box(k * 32, 0, 10, row(marks[14]), (150, 20, 28))                # its grip
    picture.box(0, top + 0.03 * height, SIZE, 8, yellow)
    picture.box(0, bottom - 0.07 * height, SIZE, 10, red)
    # Front: a sunflower, the name, a bar.
    picture.box(-68, top + 0.08 * height, 136, 0.80 * height, cream)
    middle = top + 0.30 * height
    for k in range(14):
        a = 2 * math.pi * k / 14
        picture.disc(38 * math.cos(a), middle + 38 * math.sin(a), 13, 13, yellow)
    picture.disc(0, middle, 31, 31, (96, 54, 22))
    picture.disc(-7, middle - 7, 12, 12, (140, 84, 36))
    picture.text(-59, top + 0.53 * height, 7, "OIL", red)
    picture.box(-60, top + 0.75 * height, 120, 9, green)
    picture.box(-60, top + 0.80 * height, 76, 9, orange)
    # Right side: a table of bars, as of ingredients.
    picture.box(98, top + 0.14 * height, 62, 0.66 * height, white)
    for k, width in enumerate((44, 30, 50, 22, 38, 48, 26, 40)):
        picture.box(104, top + (0.18 + 0.075 * k) * height, width, 6, dark)
    # Back: slanted stripes and another name.
    picture.box(192, top + 0.10 * height, 128, 0.74 * height, orange)
    for k in range(5):
        for step in range(64):
            picture.box(198 + k * 22 + 0.35 * step, top + (0.14 + 0.0045 * step) * height, 11, 3,
                        yellow if k % 2 else red)
    picture.text(203, top + 0.57 * height, 3, "ANNEAL", white)
    picture.text(236, top + 0.70 * height, 4, "6D", dark)
    # Left side: drops.
    for x, y, radius, color in ((372, 0.22, 22, yellow), (402, 0.42, 16, orange),
                                (368, 0.58, 27, yellow), (404, 0.76, 19, cream)):
        picture.disc(x, top + y * height, radius, radius * 1.25, color)
        picture.disc(x - 0.3 * radius, top + y * height - 0.3 * radius, 0.25 * radius,
                     0.4 * radius, white)
    return picture


def write_png(path, picture):
    data = b"".join(b"\0" + bytes(value for pixel in line for value in pixel)
                    for line in picture.rows)

    def chunk(kind, content):
        return (struct.pack(">I", len(content)) + kind + content +
                struct.pack(">I", zlib.crc32(kind + content)))

    header = struct.pack(">IIBBBBB", SIZE, SIZE, 8, 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) +
                     chunk(b"IDAT", zlib.compress(data, 9)) + chunk(b"IEND", b""))
    print(f"{path}: {SIZE}x{SIZE}")


# --- the cube ------------------------------------------------------------------------------------

def cube84(folder):
    """The cube of 84 mm of the real sequence: x from -84 to 0, y and z from 0 to 84."""
    def face(origin, side, up):
        corners = [origin, add(origin, side), add(add(origin, side), up), add(origin, up)]
        corners = [(scale(corner, 84.0), None) for corner in corners]
        return [(corners[0], corners[1], corners[2]), (corners[0], corners[2], corners[3])]

    x, y, z, o, far = (1, 0, 0), (0, 1, 0), (0, 0, 1), (-1, 0, 0), (0, 1, 1)
    minus_x, minus_y, minus_z = (-1, 0, 0), (0, -1, 0), (0, 0, -1)
    triangles = (face(o, y, x) + face(o, z, y) + face(o, x, z) +
                 face(far, minus_x, minus_y) + face(far, minus_y, minus_z) +
                 face(far, minus_z, minus_x))
    write_obj(folder / "cube84.obj", triangles)


def main():
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent
    measuring_cup(folder)
    oil_can(folder)
    cube84(folder)


if __name__ == "__main__":
    main()
