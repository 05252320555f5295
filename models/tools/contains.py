#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Proves by sampling that each link's visual shapes lie inside its collision shapes: vertices, edge middles, centroids."""
import os
import sys
import xml.etree.ElementTree as ElementTree

sys.dont_write_bytecode = True
import stl  # noqa: E402

SLACK = 0.02  # mm: what rounding to binary STL may push a point out
# A ray direction that no edge or facet of a drawn part runs along.
RAY = (0.5318, 0.6127, 0.5846)


class Solid:
    """Answers whether a point is inside a mesh or within SLACK of it."""

    def __init__(self, triangles):
        self.facets = []
        for a, b, c in triangles:
            u = tuple(b[i] - a[i] for i in range(3))
            v = tuple(c[i] - a[i] for i in range(3))
            h = (RAY[1] * v[2] - RAY[2] * v[1], RAY[2] * v[0] - RAY[0] * v[2], RAY[0] * v[1] - RAY[1] * v[0])
            det = u[0] * h[0] + u[1] * h[1] + u[2] * h[2]
            if abs(det) > 1e-9:
                self.facets.append((a, u, v, h, 1.0 / det))
        self.box = [(min(p[i] for t in triangles for p in t), max(p[i] for t in triangles for p in t))
                    for i in range(3)]

    def crossings(self, p):
        count = 0
        for a, u, v, h, inverse in self.facets:
            s = (p[0] - a[0], p[1] - a[1], p[2] - a[2])
            x = inverse * (s[0] * h[0] + s[1] * h[1] + s[2] * h[2])
            if 0.0 <= x <= 1.0:
                q = (s[1] * u[2] - s[2] * u[1], s[2] * u[0] - s[0] * u[2], s[0] * u[1] - s[1] * u[0])
                y = inverse * (RAY[0] * q[0] + RAY[1] * q[1] + RAY[2] * q[2])
                if y >= 0.0 and x + y <= 1.0 and inverse * (v[0] * q[0] + v[1] * q[1] + v[2] * q[2]) > 0.0:
                    count += 1
        return count

    def contains(self, p):
        if any(p[i] < self.box[i][0] - SLACK or p[i] > self.box[i][1] + SLACK for i in range(3)):
            return False
        if self.crossings(p) % 2:
            return True
        # On the surface: a point a hair away, in one of eight directions, is inside.
        for dx in (-SLACK, SLACK):
            for dy in (-SLACK, SLACK):
                for dz in (-SLACK, SLACK):
                    if self.crossings((p[0] + dx, p[1] + dy, p[2] + dz)) % 2:
                        return True
        return False


def samples(triangles):
    points = set()
    for a, b, c in triangles:
        points.update((a, b, c))
        points.add(tuple((a[i] + b[i] + c[i]) / 3 for i in range(3)))
        for p, q in ((a, b), (b, c), (c, a)):
            points.add(tuple((p[i] + q[i]) / 2 for i in range(3)))
    return points


def meshes(link, kind, folder):
    """(name, triangles) of the <kind> meshes of a link; all in mm, all at the link's origin."""
    for element in link.findall(kind):
        if element.find("origin") is not None:
            raise ValueError(f"{link.get('name')}: shapes of this model have no <origin>")
        yield element.get("name"), stl.read_binary(os.path.join(folder, element.find("geometry/mesh").get("filename")))


def main():
    urdf = sys.argv[1]
    folder = os.path.dirname(os.path.abspath(urdf))
    bad = 0
    for link in ElementTree.parse(urdf).getroot().findall("link"):
        solids = [Solid(triangles) for _, triangles in meshes(link, "collision", folder)]
        for name, triangles in meshes(link, "visual", folder):
            outside = [p for p in samples(triangles) if not any(solid.contains(p) for solid in solids)]
            if outside:
                bad += 1
                print(f"{link.get('name')}: {name}: {len(outside)} points outside, one at "
                      + " ".join(f"{x:.2f}" for x in outside[0]))
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
