#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Binary STL in one canonical form: the same solid gives the same bytes, whatever order OpenSCAD wrote its facets in."""
import struct
import sys


def read_ascii(path):
    """Triangles of an ASCII STL, as tuples of three vertices (mm)."""
    vertices = []
    with open(path, encoding="ascii") as file:
        for line in file:
            words = line.split()
            if words and words[0] == "vertex":
                vertices.append(tuple(round(float(word), 4) + 0.0 for word in words[1:4]))
    return [tuple(vertices[i:i + 3]) for i in range(0, len(vertices), 3)]


def read_binary(path):
    """Triangles of a binary STL."""
    with open(path, "rb") as file:
        data = file.read()
    count, = struct.unpack_from("<I", data, 80)
    if len(data) < 84 + 50 * count:
        raise ValueError(f"{path}: truncated")
    triangles = []
    for i in range(count):
        numbers = struct.unpack_from("<9f", data, 84 + 50 * i + 12)
        triangles.append((numbers[0:3], numbers[3:6], numbers[6:9]))
    return triangles


def canonical(triangles):
    """Degenerate triangles dropped, smallest vertex first (the sense is kept), sorted."""
    result = []
    for triangle in triangles:
        if len(set(triangle)) == 3:
            first = triangle.index(min(triangle))
            result.append(triangle[first:] + triangle[:first])
    return sorted(result)


def normal(triangle):
    a, b, c = triangle
    u = [b[i] - a[i] for i in range(3)]
    v = [c[i] - a[i] for i in range(3)]
    n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
    length = sum(x * x for x in n) ** 0.5
    return [x / length if length > 0 else 0.0 for x in n]


def open_edges(triangles):
    """Directed edges without exactly one opposite: none in a watertight 2-manifold whose faces look the same way."""
    count = {}
    for triangle in triangles:
        for i in range(3):
            edge = (triangle[i], triangle[(i + 1) % 3])
            count[edge] = count.get(edge, 0) + 1
    return [edge for edge, times in count.items() if times != 1 or count.get((edge[1], edge[0]), 0) != 1]


def volume(triangles):
    """Signed volume, mm^3: positive when the normals look outward."""
    total = 0.0
    for a, b, c in triangles:
        total += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2])
                  + a[2] * (b[0] * c[1] - b[1] * c[0]))
    return total / 6.0


def write_binary(path, triangles):
    with open(path, "wb") as file:
        file.write(b"ncsim model, mm".ljust(80, b" "))
        file.write(struct.pack("<I", len(triangles)))
        for triangle in triangles:
            file.write(struct.pack("<3f", *normal(triangle)))
            for vertex in triangle:
                file.write(struct.pack("<3f", *vertex))
            file.write(b"\0\0")


def main():
    if len(sys.argv) != 3:
        sys.exit("usage: stl.py ASCII_STL BINARY_STL")
    triangles = canonical(read_ascii(sys.argv[1]))
    if not triangles:
        sys.exit(f"{sys.argv[1]}: no triangles")
    if open_edges(triangles):
        sys.exit(f"{sys.argv[1]}: not watertight, {len(open_edges(triangles))} open edges")
    if volume(triangles) <= 0.0:
        sys.exit(f"{sys.argv[1]}: normals look inward")
    write_binary(sys.argv[2], triangles)


if __name__ == "__main__":
    main()
