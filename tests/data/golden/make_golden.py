#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Anneal6D authors
"""Writes the golden files beside it: one box in every model format, one camera in every calibration
format. Python's standard library alone; the same bytes every time.

The box spans x -20..20, y -30..30, z -40..40 mm. Texture coordinates follow from the position, so
that a test can check them in every format: u = (x + 20) / 80 + (y + 30) / 120, v = (40 - z) / 80 from
the top of the picture. The picture is 4x2 pixels: upper row red, lower row blue.
"""

import base64
import json
import pathlib
import struct
import zlib

HERE = pathlib.Path(__file__).resolve().parent
HALF = (20.0, 30.0, 40.0)
# Corner i has the sign bits of i: bit 0 is x, bit 1 is y, bit 2 is z.
CORNERS = [tuple(h if i >> axis & 1 else -h for axis, h in enumerate(HALF)) for i in range(8)]
# Outward normal and four corners, counter-clockwise seen from outside.
FACES = [
    ((-1, 0, 0), (0, 4, 6, 2)),
    ((1, 0, 0), (1, 3, 7, 5)),
    ((0, -1, 0), (0, 1, 5, 4)),
    ((0, 1, 0), (2, 6, 7, 3)),
    ((0, 0, -1), (0, 2, 3, 1)),
    ((0, 0, 1), (4, 5, 7, 6)),
]
WIDTH, HEIGHT = 4, 2
RED, BLUE = (255, 0, 0), (0, 0, 255)


def uv(point):
    x, y, z = point
    return (x + 20) / 80 + (y + 30) / 120, (40 - z) / 80


def triangles():
    """(normal, three points) of each of the twelve."""
    for normal, (a, b, c, d) in FACES:
        yield normal, (CORNERS[a], CORNERS[b], CORNERS[c])
        yield normal, (CORNERS[a], CORNERS[c], CORNERS[d])


def write(name, content):
    if isinstance(content, str):
        content = content.encode()
    (HERE / name).write_bytes(content)


def png():
    rows = b"".join(b"\0" + bytes(colour) * WIDTH for colour in (RED, BLUE))

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    return (b"\x89PNG\r\n\x1a\n"
            + chunk(b"IHDR", struct.pack(">IIBBBBB", WIDTH, HEIGHT, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def bmp():
    # 24 bits, rows from the bottom, BGR; a row of 4 pixels needs no padding.
    pixels = b"".join(bytes(reversed(colour)) * WIDTH for colour in (BLUE, RED))
    header = struct.pack("<IiiHHIIiiII", 40, WIDTH, HEIGHT, 1, 24, 0, len(pixels), 0, 0, 0, 0)
    return struct.pack("<2sIHHI", b"BM", 54 + len(pixels), 0, 0, 54) + header + pixels


def float_matrix(columns, values):
    return (b"MATRIX %010d %010d " % (columns, len(values) // columns)
            + struct.pack("<%df" % len(values), *values))


def write_dat():
    corners, coordinates = [], []
    for normal, points in triangles():
        for point in points:
            corners += [*normal, *point]
            coordinates += uv(point)
    for name, columns in (("box18", 18), ("box6", 6)):
        write(name + ".dat", float_matrix(columns, corners))
        write(name + "Tex.dat", float_matrix(6, coordinates))
        write(name + ".bmp", bmp())
    write("plain.dat", float_matrix(18, corners))


def write_obj():
    lines = ["# quads; v is counted from the bottom in OBJ", "mtllib box.mtl"]
    lines += ["v %g %g %g" % p for p in CORNERS]
    lines += ["vt %.9g %.9g" % (uv(p)[0], 1 - uv(p)[1]) for p in CORNERS]
    lines += ["vn %g %g %g" % normal for normal, _ in FACES]
    lines += ["usemtl painted"]
    for i, (_, corners) in enumerate(FACES):
        lines += ["f " + " ".join("%d/%d/%d" % (c + 1, c + 1, i + 1) for c in corners)]
    write("box.obj", "\n".join(lines) + "\n")
    write("box.mtl", "newmtl painted\nKd 0.5 0.75 1\nmap_Kd box.png\n")
    write("box.png", png())


def write_ply():
    # Corner colours: red grows with x, green with y, blue with z.
    header = ["ply", "format ascii 1.0", "element vertex 8", "property float x", "property float y",
              "property float z", "property uchar red", "property uchar green",
              "property uchar blue", "element face 6", "property list uchar int vertex_indices",
              "end_header"]
    rows = ["%g %g %g %d %d %d" % (*p, *(255 if c > 0 else 0 for c in p)) for p in CORNERS]
    rows += ["4 %d %d %d %d" % corners for _, corners in FACES]
    write("box.ply", "\n".join(header + rows) + "\n")
    header[1] = "format binary_little_endian 1.0"
    body = b"".join(struct.pack("<3f3B", *p, *(255 if c > 0 else 0 for c in p)) for p in CORNERS)
    body += b"".join(struct.pack("<B4i", 4, *corners) for _, corners in FACES)
    write("box_binary.ply", ("\n".join(header) + "\n").encode() + body)


def write_stl():
    lines = ["solid box"]
    binary = b"box".ljust(80, b"\0") + struct.pack("<I", 2 * len(FACES))
    for normal, points in triangles():
        lines += ["facet normal %g %g %g" % normal, "outer loop"]
        lines += ["vertex %g %g %g" % p for p in points] + ["endloop", "endfacet"]
        binary += struct.pack("<12fH", *normal, *points[0], *points[1], *points[2], 0)
    write("box.stl", "\n".join(lines + ["endsolid box"]) + "\n")
    write("box_binary.stl", binary)


def write_gltf():
    # Lengths in metres and the box lying on its side: the node puts both right (x -> y -> z -> x).
    positions, normals, coordinates = b"", b"", b""
    for normal, points in triangles():
        for p in points:
            positions += struct.pack("<3f", p[1] / 1000, p[2] / 1000, p[0] / 1000)
            normals += struct.pack("<3f", normal[1], normal[2], normal[0])
            coordinates += struct.pack("<2f", *uv(p))
    indices = struct.pack("<36H", *range(36))
    parts = [positions, normals, coordinates, indices, png()]
    buffer, views = b"", []
    for part in parts:
        views.append({"buffer": 0, "byteOffset": len(buffer), "byteLength": len(part)})
        buffer += part + b"\0" * (-len(part) % 4)
    extent = [HALF[1] / 1000, HALF[2] / 1000, HALF[0] / 1000]

    def accessor(view, component, count, kind, **more):
        return {"bufferView": view, "componentType": component, "count": count, "type": kind, **more}

    scene = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        # Column by column: the file's (y, z, x) to (x, y, z).
        "nodes": [{"mesh": 0, "matrix": [0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0, 0, 1]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2},
                                    "indices": 3, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0},
                                                "baseColorFactor": [1, 0.214041144, 0, 1]}}],
        "textures": [{"source": 0}], "images": [{"bufferView": 4, "mimeType": "image/png"}],
        "bufferViews": views,
        "accessors": [accessor(0, 5126, 36, "VEC3", min=[-e for e in extent], max=extent),
                      accessor(1, 5126, 36, "VEC3"), accessor(2, 5126, 36, "VEC2"),
                      accessor(3, 5123, 36, "SCALAR")],
    }
    buffers = [{"byteLength": len(buffer)}]
    text = json.dumps({**scene, "buffers": buffers}).encode()
    text += b" " * (-len(text) % 4)
    write("box.glb", struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(buffer))
          + struct.pack("<I4s", len(text), b"JSON") + text
          + struct.pack("<I4s", len(buffer), b"BIN\0") + buffer)
    # The picture as a file of its own, the numbers inside.
    uri = "data:application/octet-stream;base64," + base64.b64encode(buffer).decode()
    scene["images"] = [{"uri": "box.png"}]
    write("box.gltf", json.dumps({**scene, "buffers": [{**buffers[0], "uri": uri}]}, indent=1) + "\n")


def write_cao():
    # Four sides in a file of its own, the others as faces from points and from lines; in metres.
    lines = ["V1", "# sides of the box", "8 # points"]
    lines += ["%g %g %g # point %d" % (*(c / 1000 for c in p), i) for i, p in enumerate(CORNERS)]
    sides = lines + ["0 # lines", "0 # faces from lines", "4 # faces from points"]
    sides += ["4 %d %d %d %d name=\"side %d\" useLod=false" % (*corners, i)
              for i, (_, corners) in enumerate(FACES[:4])]
    write("box_sides.cao", "\r\n".join(sides + ["0 # cylinders", "0 # circles"]) + "\r\n")
    bottom, top = FACES[4][1], FACES[5][1]
    ends = ["V1", 'load("box_sides.cao")'] + lines[2:] + ["4 # lines"]
    # One of the lines runs the other way.
    ends += ["%d %d" % pair for pair in zip(top, top[1:])] + ["%d %d" % (top[0], top[3])]
    ends += ["1 # faces from lines", "4 0 1 2 3", "1 # faces from points", "4 %d %d %d %d" % bottom]
    write("box.cao", "\n".join(ends + ["0", "0"]) + "\n")


def write_cameras():
    # 640x480, fx 800.5, fy 801.25, cx 320.125, cy 240.75; k1 -0.25, k2 0.125, p1 0.001, p2 -0.002.
    matrix = [800.5, 0, 320.125, 0, 801.25, 240.75, 0, 0, 1]
    distortion = [-0.25, 0.125, 0.001, -0.002]
    identity = [1, 0, 0, 0, 1, 0, 0, 0, 1]

    def numbers(values):
        return "".join("%.10f " % v for v in values)

    def ivt_camera(shift_mm):
        return numbers([640, 480, *matrix]) + "\n" + numbers(distortion) + "\n" + numbers(
            [*identity, shift_mm, 0, 0]) + "\n"

    corners = [0, 0, 639, 0, 639, 479, 0, 479] * 2
    write("ivt_mono.txt", "1\n\n" + ivt_camera(0))
    write("ivt_stereo.txt", "2\n\n" + ivt_camera(0) + ivt_camera(-90) + "\n" + numbers(corners) + "\n"
          + numbers(identity + identity) + "\n")

    def listing(values):
        return "[" + ", ".join("%g" % v for v in values) + "]"

    write("ros.yaml", "image_width: 640\nimage_height: 480\ncamera_name: left/camera_0\n"
          "camera_matrix:\n  rows: 3\n  cols: 3\n  data: %s\n"
          "distortion_model: plumb_bob\n"
          "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: %s\n"
          "rectification_matrix:\n  rows: 3\n  cols: 3\n  data: %s\n"
          "projection_matrix:\n  rows: 3\n  cols: 4\n  data: [800, 0, 320, 0, 0, 800, 240, 0,\n"
          "         0, 0, 1, 0]\n" % (listing(matrix), listing(distortion + [0]), listing(identity)))
    write("ros_flow.yaml", "# as other YAML writers put it\n"
          "camera_matrix: {cols: 3, data: %s, rows: 3}\n"
          "camera_name: 'left: 0'\n"
          "distortion_coefficients:\n  cols: 5\n  data:\n  - -0.25\n  - 0.125\n  - 0.001\n"
          "  - -0.002\n  - 0.0\n  rows: 1\n"
          "distortion_model: plumb_bob\nimage_height: 480\nimage_width: 640\n" % listing(matrix))
    write("opencv.yml", "%YAML:1.0\n---\ncalibration_time: \"Tue 10 Feb 2026 10:11:12\"\n"
          "nframes: 13\nimage_width: 640\nimage_height: 480\n"
          "# flags: +fix_k3\nflags: 128\n"
          "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
          "   data: [ 8.0050000000000000e+02, 0., 3.2012500000000000e+02, 0.,\n"
          "       8.0125000000000000e+02, 2.4075000000000000e+02, 0., 0., 1. ]\n"
          "distortion_coefficients: !!opencv-matrix\n   rows: 5\n   cols: 1\n   dt: d\n"
          "   data: [ -0.25, 0.125, 1.0000000000000000e-03, -2.0000000000000000e-03, 0. ]\n"
          "avg_reprojection_error: 2.5e-01\n")


if __name__ == "__main__":
    write_dat()
    write_obj()
    write_ply()
    write_stl()
    write_gltf()
    write_cao()
    write_cameras()
