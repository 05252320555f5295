#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A picture of a machine: URDF and STL in, PNG out. Headless, standard library only, the same bytes every time.

  render.py MODEL.urdf OUT.png [B=40 X=-300 ...] [--hide VISUAL,...] [--add MESH.stl@LINK:x,y,z:r,g,b ...]
            [--turned "d,z;d,z;..."@LINK:x,y,z:r,g,b ...] [--look x,y,z] [--from azimuth,elevation] [--span MM] [--size WxH]

Joint values are NC values: mm and degrees. --add places a mesh (mm) on a link, x, y, z in mm. --turned places a solid of
revolution about the link's Z: diameters d at heights z (a tool: LINK is spindle_gauge, z from the gauge line to the tip). The view is a parallel
projection: span is the picture's width.
"""
import argparse
import math
import os
import struct
import sys
import xml.etree.ElementTree as ElementTree
import zlib

sys.dont_write_bytecode = True
import stl  # noqa: E402

SUPER = 2                       # samples a pixel, each way
KEY_LIGHT = (0.34, -0.62, 0.86)
FILL_LIGHT = (-0.70, -0.45, 0.30)
BACKGROUND = ((0.93, 0.94, 0.96), (0.74, 0.77, 0.81))  # top, bottom
EDGE_ANGLE = math.cos(math.radians(28))


def unit(v):
    length = math.sqrt(sum(x * x for x in v))
    return tuple(x / length for x in v)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


# Poses: (three rows of a rotation, translation in mm).
def compose(a, b):
    rotation = tuple(tuple(sum(a[0][i][k] * b[0][k][j] for k in range(3)) for j in range(3)) for i in range(3))
    return rotation, apply(a, b[1])


def apply(pose, p):
    return tuple(dot(pose[0][i], p) + pose[1][i] for i in range(3))


def about(axis, angle):
    x, y, z = axis
    c, s = math.cos(angle), math.sin(angle)
    k = 1 - c
    return ((c + x * x * k, x * y * k - z * s, x * z * k + y * s),
            (y * x * k + z * s, c + y * y * k, y * z * k - x * s),
            (z * x * k - y * s, z * y * k + x * s, c + z * z * k))


IDENTITY = (about((1, 0, 0), 0.0), (0.0, 0.0, 0.0))


def numbers(text):
    return tuple(float(word) for word in text.replace(",", " ").split())


def origin(element):
    if element is None:
        return IDENTITY
    roll, pitch, yaw = numbers(element.get("rpy", "0 0 0"))
    rotation = compose((about((0, 0, 1), yaw), (0, 0, 0)),
                       compose((about((0, 1, 0), pitch), (0, 0, 0)), (about((1, 0, 0), roll), (0, 0, 0))))[0]
    return rotation, tuple(1000 * x for x in numbers(element.get("xyz", "0 0 0")))


def link_poses(robot, values):
    """Pose of every link in the root link, at NC values in mm and degrees."""
    joints = {joint.find("child").get("link"): joint for joint in robot.findall("joint")}

    def pose(link):
        if link not in joints:
            return IDENTITY
        joint = joints[link]
        result = compose(pose(joint.find("parent").get("link")), origin(joint.find("origin")))
        value = values.get(joint.get("name"), 0.0)
        if joint.get("type") != "fixed":
            axis = numbers(joint.find("axis").get("xyz"))
            if joint.get("type") == "prismatic":
                return compose(result, (IDENTITY[0], tuple(value * x for x in axis)))
            return compose(result, (about(axis, math.radians(value)), (0, 0, 0)))
        return result

    return {link.get("name"): pose(link.get("name")) for link in robot.findall("link")}


def collect(urdf, values, hidden, added):
    """Bodies to draw: (triangles in the machine frame, colour with alpha)."""
    robot = ElementTree.parse(urdf).getroot()
    colours = {m.get("name"): numbers(m.find("color").get("rgba")) for m in robot.findall("material")}
    poses = link_poses(robot, values)
    bodies = []
    for link in robot.findall("link"):
        for visual in link.findall("visual"):
            if visual.get("name") in hidden:
                continue
            mesh = visual.find("geometry/mesh")
            scale = 1000 * numbers(mesh.get("scale"))[0]
            place = compose(poses[link.get("name")], origin(visual.find("origin")))
            triangles = stl.read_binary(os.path.join(os.path.dirname(os.path.abspath(urdf)), mesh.get("filename")))
            bodies.append(([tuple(apply(place, tuple(scale * x for x in p)) for p in t) for t in triangles],
                           colours[visual.find("material").get("name")]))
    for item in added:
        shape, rest = item.split("@")
        link, xyz, rgb = rest.split(":")
        place = compose(poses[link], (IDENTITY[0], numbers(xyz)))
        colour = numbers(rgb)
        triangles = turned(shape) if ";" in shape else stl.read_binary(shape)
        bodies.append(([tuple(apply(place, p) for p in t) for t in triangles],
                       colour if len(colour) == 4 else colour + (1.0,)))
    return bodies


def turned(profile, sides=48):
    """Triangles of a solid of revolution about Z; "d,z;d,z;..." with z not falling."""
    rings = []
    for d, z in (numbers(pair) for pair in profile.split(";")):
        rings.append([(d / 2 * math.cos(2 * math.pi * k / sides), d / 2 * math.sin(2 * math.pi * k / sides), z)
                      for k in range(sides)])
    triangles = []
    for k in range(sides):
        n = (k + 1) % sides
        triangles.append(((0.0, 0.0, rings[0][0][2]), rings[0][n], rings[0][k]))
        triangles.append(((0.0, 0.0, rings[-1][0][2]), rings[-1][k], rings[-1][n]))
        for low, high in zip(rings, rings[1:]):
            triangles.append((low[k], low[n], high[n]))
            triangles.append((low[k], high[n], high[k]))
    return triangles


class Camera:
    """Parallel projection. x right, y down in samples; depth grows away from the eye (mm)."""

    def __init__(self, look, azimuth, elevation, span, width, height):
        a, e = math.radians(azimuth), math.radians(elevation)
        self.toward = (math.sin(a) * math.cos(e), -math.cos(a) * math.cos(e), math.sin(e))  # to the eye
        self.right = unit(cross((0, 0, 1), self.toward))
        self.up = cross(self.toward, self.right)
        self.look, self.width, self.height = look, width, height
        self.scale = width / span

    def project(self, p):
        d = tuple(p[i] - self.look[i] for i in range(3))
        return (self.width / 2 + self.scale * dot(d, self.right), self.height / 2 - self.scale * dot(d, self.up),
                -dot(d, self.toward))


def fill(points, width, height, visit):
    """Calls visit(row offset, first x, last x, depth at first x, depth step) for each row of a projected triangle."""
    (x0, y0, z0), (x1, y1, z1), (x2, y2, z2) = points
    area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)
    if abs(area) < 1e-9:
        return
    zx = ((z1 - z0) * (y2 - y0) - (z2 - z0) * (y1 - y0)) / area
    zy = ((x1 - x0) * (z2 - z0) - (x2 - x0) * (z1 - z0)) / area
    edges = ((x0, y0, x1, y1), (x1, y1, x2, y2), (x2, y2, x0, y0))
    for y in range(max(0, math.ceil(min(y0, y1, y2) - 0.5)), min(height - 1, math.floor(max(y0, y1, y2) - 0.5)) + 1):
        centre = y + 0.5
        low, high = math.inf, -math.inf
        for xa, ya, xb, yb in edges:
            if (ya <= centre < yb) or (yb <= centre < ya):
                x = xa + (centre - ya) * (xb - xa) / (yb - ya)
                low, high = min(low, x), max(high, x)
        first, last = max(0, math.ceil(low - 0.5)) if low < math.inf else 1, min(width - 1, math.floor(high - 0.5)) \
            if high > -math.inf else 0
        if first <= last:
            visit(y * width, first, last, z0 + zx * (first + 0.5 - x0) + zy * (centre - y0), zx)


def depth_map(triangles, camera):
    size = camera.width * camera.height
    depth = [math.inf] * size
    ids = [-1] * size
    for number, (points, toward) in enumerate(triangles):
        if not toward:
            continue

        def visit(row, first, last, z, step):
            for i in range(row + first, row + last + 1):
                if z < depth[i]:
                    depth[i] = z
                    ids[i] = number
                z += step

        fill(points, camera.width, camera.height, visit)
    return depth, ids


def feature_edges(triangles):
    """Edges where the surface turns sharply, as pairs of points."""
    owners = {}
    for t in triangles:
        n = stl.normal(t)
        for i in range(3):
            a, b = t[i], t[(i + 1) % 3]
            owners.setdefault((min(a, b), max(a, b)), []).append(n)
    return [edge for edge, normals in owners.items() if len(normals) == 2 and dot(*normals) < EDGE_ANGLE]


class Picture:
    def __init__(self, bodies, camera):
        self.camera = camera
        self.colours = []
        self.normals = []
        self.bodies = bodies
        key, fill_light = unit(KEY_LIGHT), unit(FILL_LIGHT)
        projected = []
        self.world = []
        for triangles, colour in bodies:
            for t in triangles:
                n = stl.normal(t)
                self.world.append(t)
                self.normals.append(n)
                lit, bounce = max(0.0, dot(n, key)), max(0.0, dot(n, fill_light))
                ambient = 0.44 + 0.12 * n[2]
                self.colours.append((colour, ambient + 0.16 * bounce, 0.58 * lit))
                projected.append((tuple(camera.project(p) for p in t), dot(n, camera.toward) > 1e-9))
        self.opaque = [(p, toward and self.colours[i][0][3] >= 1.0) for i, (p, toward) in enumerate(projected)]
        self.clear = [(p, i) for i, (p, toward) in enumerate(projected) if toward and self.colours[i][0][3] < 1.0]
        self.depth, self.ids = depth_map(self.opaque, camera)
        self.shadow_setup(key)

    def shadow_setup(self, key):
        azimuth = math.degrees(math.atan2(key[0], -key[1]))
        elevation = math.degrees(math.asin(key[2]))
        size = 1500
        self.sun = Camera(self.camera.look, azimuth, elevation, 1.5 * self.camera.width / self.camera.scale, size, size)
        light_triangles = [(tuple(self.sun.project(p) for p in t), self.colours[i][0][3] >= 1.0)
                           for i, t in enumerate(self.world)]
        self.sun_depth, _ = depth_map(light_triangles, self.sun)

    def shade(self):
        """Colour of each sample, row by row from the top."""
        camera, sun = self.camera, self.sun
        width, height = camera.width, camera.height
        image = [None] * (width * height)
        right, up, toward, look = camera.right, camera.up, camera.toward, camera.look
        limit = sun.width
        for y in range(height):
            v = (height / 2 - y - 0.5) / camera.scale
            mix = y / (height - 1)
            back = tuple(BACKGROUND[0][i] * (1 - mix) + BACKGROUND[1][i] * mix for i in range(3))
            for x in range(width):
                i = y * width + x
                number = self.ids[i]
                if number < 0:
                    image[i] = back
                    continue
                u = (x + 0.5 - width / 2) / camera.scale
                z = self.depth[i]
                colour, base, lit = self.colours[number]
                n = self.normals[number]
                if lit > 0.0:
                    p = tuple(look[k] + u * right[k] + v * up[k] - z * toward[k] + 3.0 * n[k] for k in range(3))
                    sx, sy, sz = sun.project(p)
                    hidden = 0
                    for ox, oy in ((-0.4, -0.4), (0.6, -0.4), (-0.4, 0.6), (0.6, 0.6)):
                        column, row = int(sx + ox), int(sy + oy)
                        if 0 <= column < limit and 0 <= row < limit \
                                and self.sun_depth[row * limit + column] < sz - 4.0:
                            hidden += 1
                    base += lit * (1 - 0.8 * hidden / 4)
                image[i] = (min(1.0, colour[0] * base), min(1.0, colour[1] * base), min(1.0, colour[2] * base))
        return image

    def darken_corners(self, image):
        """Ambient occlusion from the depth map: a sample with much in front of it around it is in a corner."""
        width, height = self.camera.width, self.camera.height
        depth, scale = self.depth, self.camera.scale
        reach = [(int(round(r * math.cos(a))), int(round(r * math.sin(a))), r / scale)
                 for r in (6, 16, 34) for a in (0.3 + k * math.pi / 4 for k in range(8))]
        result = {}
        step = 4
        for y in range(0, height, step):
            for x in range(0, width, step):
                z = depth[y * width + x]
                if z == math.inf:
                    result[(y, x)] = 1.0
                    continue
                closed = 0.0
                for dx, dy, distance in reach:
                    column, row = min(max(x + dx, 0), width - 1), min(max(y + dy, 0), height - 1)
                    ahead = z - depth[row * width + column]
                    if 0.35 * distance < ahead < 6 * distance + 60:
                        closed += min(1.0, ahead / (2.5 * distance))
                result[(y, x)] = 1.0 - 0.42 * min(1.0, closed / len(reach) * 1.6)
        for y in range(height):
            top = y // step * step
            for x in range(width):
                i = y * width + x
                if depth[i] < math.inf:
                    k = result[(top, x // step * step)]
                    c = image[i]
                    image[i] = (c[0] * k, c[1] * k, c[2] * k)

    def draw_edges(self, image):
        camera = self.camera
        width, height = camera.width, camera.height
        for triangles, colour in self.bodies:
            for a, b in feature_edges(triangles):
                xa, ya, za = camera.project(a)
                xb, yb, zb = camera.project(b)
                steps = int(max(abs(xb - xa), abs(yb - ya))) + 1
                for k in range(steps + 1):
                    f = k / steps
                    x, y = int(xa + f * (xb - xa)), int(ya + f * (yb - ya))
                    if 0 <= x < width and 0 <= y < height:
                        i = y * width + x
                        if za + f * (zb - za) < self.depth[i] + 5.0:
                            c = image[i]
                            image[i] = (c[0] * 0.5, c[1] * 0.5, c[2] * 0.5)

    def glaze(self, image):
        """Glass over what lies behind it."""
        width, height = self.camera.width, self.camera.height
        for points, number in self.clear:
            colour, base, lit = self.colours[number]
            k, shine = colour[3], base + lit

            def visit(row, first, last, z, step):
                for i in range(row + first, row + last + 1):
                    if z < self.depth[i]:
                        c = image[i]
                        image[i] = tuple(c[j] * (1 - k) + colour[j] * shine * k for j in range(3))
                    z += step

            fill(points, width, height, visit)


def write_png(path, image, width, height):
    """Averages SUPER x SUPER samples to a pixel."""
    rows = []
    for y in range(height // SUPER):
        row = bytearray(b"\0")
        for x in range(width // SUPER):
            total = [0.0, 0.0, 0.0]
            for dy in range(SUPER):
                for dx in range(SUPER):
                    c = image[(y * SUPER + dy) * width + x * SUPER + dx]
                    total[0] += c[0]
                    total[1] += c[1]
                    total[2] += c[2]
            # Six bits a channel keep the file small.
            row += bytes(min(255, int(255 * t / (SUPER * SUPER) + 0.5) & 0xFC) for t in total)
        rows.append(bytes(row))

    filtered = bytearray()
    previous = bytes(len(rows[0]))
    for row in rows:  # filter 4 (Paeth) packs smooth pictures best
        filtered.append(4)
        for i in range(1, len(row)):
            a, b, c = row[i - 3] if i > 3 else 0, previous[i], previous[i - 3] if i > 3 else 0
            p = a + b - c
            pa, pb, pc = abs(p - a), abs(p - b), abs(p - c)
            filtered.append((row[i] - (a if pa <= pb and pa <= pc else b if pb <= pc else c)) & 255)
        previous = row

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        file.write(chunk(b"IHDR", struct.pack(">IIBBBBB", width // SUPER, height // SUPER, 8, 2, 0, 0, 0)))
        file.write(chunk(b"IDAT", zlib.compress(bytes(filtered), 9)))
        file.write(chunk(b"IEND", b""))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("urdf")
    parser.add_argument("out")
    parser.add_argument("joints", nargs="*")
    parser.add_argument("--hide", default="")
    parser.add_argument("--add", action="append", default=[])
    parser.add_argument("--turned", action="append", default=[])
    parser.add_argument("--look", default="-381,-60,-330")
    parser.add_argument("--from", dest="eye", default="32,24")
    parser.add_argument("--span", type=float, default=3300.0)
    parser.add_argument("--size", default="1200x900")
    options = parser.parse_args()
    values = {name: float(value) for name, value in (joint.split("=") for joint in options.joints)}
    width, height = (SUPER * int(n) for n in options.size.split("x"))
    camera = Camera(numbers(options.look), *numbers(options.eye), options.span, width, height)
    picture = Picture(collect(options.urdf, values, options.hide.split(","), options.add + options.turned), camera)
    image = picture.shade()
    picture.darken_corners(image)
    picture.draw_edges(image)
    picture.glaze(image)
    write_png(options.out, image, width, height)


if __name__ == "__main__":
    main()
