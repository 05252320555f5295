#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes dome.nc: roughing in three axes, the wall by the flank of an end mill, the dome by a ball mill, both under G234.

Coordinates are those of part.scad. Signs on this machine: the tool axis in the part is (sin B cos C, sin B sin C, cos B).
"""
import math

SPHERE = 60.0
DOME_ANGLE = 35.0
LEAN = 15.0
WALL_BOTTOM = -45.0
RIM_R = SPHERE * math.sin(math.radians(DOME_ANGLE))
RIM_Z = SPHERE * math.cos(math.radians(DOME_ANGLE)) - SPHERE
ROUGH_R, FLANK_R, BALL_R = 8.0, 6.0, 5.0
RATE = 42.0          # deg/s that feeds ask of C at most; the machine has 50
LIFT = 0.1           # mm that the flank cutter stays above the flange


def number(value):
    """As a Haas post writes it: at most three decimals, always a point, no negative zero."""
    text = f"{value:.3f}".rstrip("0")
    return "0." if text in ("-0.", "0.") else text


class Program:
    def __init__(self):
        self.lines = []
        self.count = 0

    def raw(self, text):
        self.lines.append(text)

    def block(self, text):
        self.count += 5
        self.lines.append(f"N{self.count} {text}")


def axis(b, c):
    b, c = math.radians(b), math.radians(c)
    return (math.sin(b) * math.cos(c), math.sin(b) * math.sin(c), math.cos(b))


def turned(p, b, c):
    """R = Ry(-B) Rz(-C): where a table-fixed point goes. Under G254 it is the point to program."""
    b, c = math.radians(b), math.radians(c)
    x = p[0] * math.cos(c) + p[1] * math.sin(c)
    y = -p[0] * math.sin(c) + p[1] * math.cos(c)
    return (x * math.cos(b) - p[2] * math.sin(b), y, x * math.sin(b) + p[2] * math.cos(b))


def along(p, direction, distance):
    return tuple(p[i] + distance * direction[i] for i in range(3))


def xyz(p):
    return f"X{number(p[0])} Y{number(p[1])} Z{number(p[2])}"


def tool_change(out, tool, name, speed):
    out.raw("")
    out.raw(f"({name})")
    out.block("G53 G00 Z0.")
    out.block(f"T{tool} M06")
    out.block(f"S{speed} M03")
    out.block("G54")


def begin_tcp(out, tool, p, b, c):
    """Turns the table, stands over the start point with Z up, then lets Z alone bring the tip down to it."""
    over = turned(p, b, c)
    out.block("M11")
    out.block("M13")
    out.block(f"G00 B{number(b)} C{number(c)}")
    out.block("G254")
    out.block(f"G00 X{number(over[0])} Y{number(over[1])}")
    out.block("G255")
    out.block(f"G00 G234 H{tool:02d} {xyz(p)}")
    out.block("M08")


def end_tcp(out):
    out.block("M09")
    out.block("G53 G00 Z0.")
    out.block("G49")


def rough(out):
    tool_change(out, 1, "ROUGH OUTSIDE AND DOME, D16 END MILL", 6000)
    foot = RIM_R + math.tan(math.radians(LEAN)) * (RIM_Z - WALL_BOTTOM)
    centre = foot + ROUGH_R + 1.0
    out.block("M11")
    out.block("M13")
    out.block("G00 B0. C0.")
    out.block("M10")
    out.block("M12")
    out.block("G00 X85. Y0.")
    out.block("G43 H01 Z20.")
    out.block("M08")
    out.block("G00 Z5.")
    out.raw("(OUTSIDE, 4 MM A LEVEL)")
    out.block("#101= -4.")
    out.block("WHILE [#101 GE -44.] DO1")
    out.block("G01 Z#101 F3000.")
    out.block(f"G01 X{number(centre)} F1200.")
    out.block(f"G02 I-{number(centre)}")
    out.block("G01 X85. F3000.")
    out.block("#101= #101 - 4.")
    out.block("END1")
    out.block("G00 Z5.")
    out.raw("(TERRACES OF THE DOME)")
    for z in (-2.0, -4.0, -6.0, -8.0, -10.0):
        inner = math.sqrt(SPHERE ** 2 - (SPHERE + z) ** 2) + ROUGH_R + 0.4
        radius = centre
        out.block(f"G01 Z{number(z)} F3000.")
        while True:
            radius = max(inner, radius - 8.0)
            out.block(f"G01 X{number(radius)} F1200.")
            out.block(f"G02 I-{number(radius)}")
            if radius <= inner:
                break
        out.block("G01 X85. F3000.")
    out.block("G00 Z20.")
    out.block("M09")
    out.block("G53 G00 Z0.")
    out.block("G49")


def wall_tip(angle, offset):
    """Tip with the flank `offset` mm off the wall, its edge just above the flange, at a polar angle in degrees."""
    lean, a = math.radians(LEAN), math.radians(angle)
    z = WALL_BOTTOM + LIFT
    r = RIM_R + math.tan(lean) * (RIM_Z - z)
    r += (FLANK_R + offset) * math.cos(lean)
    return (r * math.cos(a), r * math.sin(a), z + (FLANK_R + offset) * math.sin(lean))


def wall(out):
    tool_change(out, 2, "WALL BY THE FLANK, D12 END MILL, B-15, C TURNS", 8000)
    b = -LEAN
    start = wall_tip(0.0, 20.0)
    begin_tcp(out, 2, along(start, axis(b, 0.0), 90.0), b, 0.0)
    out.block(f"G01 {xyz(start)} F3000.")
    c = 0.0
    for offset in (6.0, 3.0, 0.5, 0.0):
        out.raw(f"(STOCK LEFT {number(offset)})")
        out.block(f"G01 {xyz(wall_tip(c, offset))} F800.")
        for _ in range(90):
            c += 4.0
            p, q = wall_tip(c - 4.0, offset), wall_tip(c, offset)
            feed = min(1500.0, 60.0 * RATE * math.dist(p, q) / 4.0)
            out.block(f"G01 {xyz(q)} C{number(c)} F{number(math.floor(feed))}")
    end = wall_tip(c, 20.0)
    out.block(f"G01 {xyz(end)} F3000.")
    out.block(f"G00 {xyz(along(end, axis(b, c), 90.0))}")
    end_tcp(out)


def dome_tip(polar, tilt, c):
    centre = along((0.0, 0.0, -SPHERE), axis(polar, c), SPHERE + BALL_R)
    return along(centre, axis(tilt, c), -BALL_R)


def dome(out):
    tool_change(out, 3, "DOME, D10 BALL MILL, SPIRAL FROM THE RIM TO THE TOP", 10000)
    last, pitch = 1.0, 1.5
    turns = (DOME_ANGLE - last) / pitch

    def pose(c):
        polar = max(last, DOME_ANGLE - pitch * c / 360.0)
        tilt = 4.0 + 0.9 * polar
        return dome_tip(polar, tilt, c), tilt

    p, b = pose(0.0)
    begin_tcp(out, 3, along(p, axis(b, 0.0), 60.0), b, 0.0)
    out.block(f"G01 {xyz(p)} F1500.")
    c = 0.0
    total = 360.0 * (turns + 1.0)
    while c < total:
        radius = math.hypot(p[0], p[1])
        step = min(12.0, max(4.0, math.degrees(2.0 * math.acos(1.0 - min(0.02 / radius, 0.9)))))
        c = min(total, c + step)
        q, b = pose(c)
        feed = min(1500.0, 60.0 * RATE * math.dist(p, q) / step)
        out.block(f"G01 {xyz(q)} B{number(b)} C{number(c)} F{number(math.floor(feed * 10.0) / 10.0)}")
        p = q
    out.block(f"G00 {xyz(along(p, axis(b, c), 60.0))}")
    end_tcp(out)


def main():
    out = Program()
    out.raw("%")
    out.raw("O02001 (DOME ON A TAPERED WALL)")
    out.raw("(WRITTEN BY GENERATE.PY)")
    out.raw("(T1 D=16. CR=0. - ZMIN=-44. - FLAT END MILL)")
    out.raw("(T2 D=12. CR=0. - ZMIN=-44.9 - FLAT END MILL)")
    out.raw("(T3 D=10. CR=5. - ZMIN=-10.9 - BALL END MILL)")
    out.block("G21 G17 G40 G49 G80 G90 G94")
    rough(out)
    wall(out)
    dome(out)
    out.raw("")
    out.raw("(END: UNWIND, TABLE FLAT)")
    out.block("G00 B0. C0.")
    out.block("M10")
    out.block("M12")
    out.block("G53 G00 X-736.6 Y-203.2")
    out.block("M05")
    out.block("M30")
    out.raw("%")
    print("\n".join(out.lines))


if __name__ == "__main__":
    main()
