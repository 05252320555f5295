#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes hub.cls as NX would: a face, a bore by helices, a cone roughed in circles, finished with five axes, and three holes
square to it.

Coordinates are those of part.scad, mm. The points are the middle of the tool's end.
"""
import math

TOP_R, OUTER_R, CONE_BOTTOM = 25.0, 50.0, -25.0
BORE_R, BORE_DEPTH = 12.0, 20.0
HOLE_DEPTH, DRILL_R, POINT_DEG = 18.0, 4.0, 118.0
MILL_R, BALL_R = 8.0, 5.0
ALLOWANCE = 0.5
TILT = 30.0          # of the ball mill, outwards: it cuts with its side
SAFE = 30.0          # above the top face


def number(value):
    text = f"{value:.6f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def numbers(*values):
    return ",".join(number(v) for v in values)


def lines():
    yield "$$ a hub: the sample of ncsim post"
    yield "UNITS/MM"
    yield from top_face()
    yield from bore()
    yield from cone_rough()
    yield from cone_finish()
    yield from holes()
    yield "FINI"


def operation(name, tool, kind, number_, speed, zero=(0.0, 0.0, 0.0)):
    yield f"TOOL PATH/{name},TOOL,{tool}"
    yield f"TLDATA/{kind}"
    yield f"MSYS/{numbers(*zero)},1,0,0,0,1,0"
    yield f"LOAD/TOOL,{number_}"
    yield f"SPINDL/RPM,{speed},CLW"
    yield "COOLNT/FLOOD"


def end_mill():
    return numbers(2 * MILL_R, 0, 75, 0, 0)


def top_face():
    yield from operation("TOP_FACE", "END_MILL_16", "MILL," + end_mill(), 1, 4000)
    yield "RAPID"
    yield f"GOTO/{numbers(-64, -24, SAFE, 0, 0, 1)}"
    yield "RAPID"
    yield f"GOTO/{numbers(-64, -24, 2)}"
    yield "FEDRAT/MMPM,800"
    yield f"GOTO/{numbers(-64, -24, 0)}"
    x = -64.0
    for row, y in enumerate((-24, -12, 0, 12, 24)):
        x = -x
        yield f"GOTO/{numbers(x, y, 0)}"
        if y < 24:  # round to the next row, outside of the stock
            yield f"CIRCLE/{numbers(x, y + 6, 0, 0, 0, -1 if row % 2 == 0 else 1, 6, 0.003, 0.5, 16, 0)}"
            yield f"GOTO/{numbers(x, y + 12, 0)}"
    yield "RAPID"
    yield f"GOTO/{numbers(x, 24, SAFE)}"
    yield "END-OF-PATH"


def bore():
    yield from operation("BORE", "END_MILL_16", "MILL," + end_mill(), 1, 4000)
    r = BORE_R - MILL_R
    yield "RAPID"
    yield f"GOTO/{numbers(r, 0, SAFE, 0, 0, 1)}"
    yield "RAPID"
    yield f"GOTO/{numbers(r, 0, 2)}"
    yield "FEDRAT/MMPM,400"
    yield f"GOTO/{numbers(r, 0, 0)}"
    turns = 8
    # NX turns clockwise about the axis that is stated: about -Z for climb milling.
    yield f"CIRCLE/{numbers(0, 0, 0, 0, 0, -1, r, 0.003, 0.5, 16, 0)},TIMES,{turns}"
    yield f"GOTO/{numbers(r, 0, -BORE_DEPTH)}"
    yield f"CIRCLE/{numbers(0, 0, -BORE_DEPTH, 0, 0, -1, r, 0.003, 0.5, 16, 0)}"
    yield f"GOTO/{numbers(r, 0, -BORE_DEPTH)}"
    yield f"GOTO/{numbers(0, 0, -BORE_DEPTH + 1)}"
    yield "RAPID"
    yield f"GOTO/{numbers(0, 0, SAFE)}"
    yield "END-OF-PATH"


def cone_rough():
    yield from operation("CONE_ROUGH", "END_MILL_16", "MILL," + end_mill(), 1, 4000)
    yield "RAPID"
    yield f"GOTO/{numbers(64, -20, SAFE, 0, 0, 1)}"
    for z in (-5, -10, -15, -20, -25):
        # The lower edge of the mill keeps the allowance from the cone.
        r = TOP_R - z + ALLOWANCE * math.sqrt(2.0) + MILL_R
        if z > -20:  # what lies outside goes first
            passes = (OUTER_R + 4.0, r) if r < OUTER_R - 2.0 else (r,)
        else:
            passes = (r,)
        for radius in passes:
            yield "RAPID"
            yield f"GOTO/{numbers(radius + 10, -20, 2)}"
            yield "FEDRAT/MMPM,1200"
            yield f"GOTO/{numbers(radius + 10, -20, z)}"
            yield "FEDRAT/MMPM,800"
            yield f"GOTO/{numbers(radius, 0, z)}"
            yield f"CIRCLE/{numbers(0, 0, z, 0, 0, 1, radius, 0.003, 0.5, 16, 0)}"
            yield f"GOTO/{numbers(radius, 0, z)}"
            yield f"GOTO/{numbers(radius + 10, 20, z)}"
            yield "RAPID"
            yield f"GOTO/{numbers(radius + 10, 20, 2)}"
    yield "RAPID"
    yield f"GOTO/{numbers(64, 20, SAFE)}"
    yield "END-OF-PATH"


def ball(s, angle):
    """Tip and axis of the ball mill: s mm down the cone from its upper edge, at an angle about Z."""
    normal_r = normal_z = math.sqrt(0.5)
    r = TOP_R + s * math.sqrt(0.5) + BALL_R * normal_r
    z = -s * math.sqrt(0.5) + BALL_R * normal_z
    axis_r, axis_z = math.sin(math.radians(TILT)), math.cos(math.radians(TILT))
    r -= BALL_R * axis_r
    z -= BALL_R * axis_z
    c, q = math.cos(angle), math.sin(angle)
    return (r * c, r * q, z, axis_r * c, axis_r * q, axis_z)


def cone_finish():
    yield from operation("CONE_FINISH", "BALL_MILL_10", "MILL," + numbers(2 * BALL_R, BALL_R, 60, 0, 0), 2, 6000)
    slant = (OUTER_R - TOP_R) * math.sqrt(2.0)
    turns, steps = 9, 72
    x, y, z, i, j, k = ball(0.0, 0.0)
    yield "RAPID"
    yield f"GOTO/{numbers(x + 60 * i, y + 60 * j, z + 60 * k, i, j, k)}"
    yield "RAPID"
    yield f"GOTO/{numbers(x + 5 * i, y + 5 * j, z + 5 * k, i, j, k)}"
    yield "FEDRAT/MMPM,600"
    # One spiral down the cone: C winds up turn by turn.
    for n in range(turns * steps + 1):
        s = 1.0 + (slant - 2.0) * n / (turns * steps)
        yield f"GOTO/{numbers(*ball(s, 2 * math.pi * n / steps))}"
    x, y, z, i, j, k = ball(slant - 1.0, 0.0)
    yield "RAPID"
    yield f"GOTO/{numbers(x + 60 * i, y + 60 * j, z + 60 * k, i, j, k)}"
    yield "END-OF-PATH"


def holes():
    yield from operation("HOLES", "DRILL_8", "DRILL," + numbers(2 * DRILL_R, 0, 100, POINT_DEG, 50), 3, 2500)
    h = math.sqrt(0.5)
    for n, angle in enumerate((0.0, 120.0, 240.0)):
        a = math.radians(angle)
        i, j, k = h * math.cos(a), h * math.sin(a), h
        x, y, z = 37.5 * math.cos(a), 37.5 * math.sin(a), -12.5
        yield "RAPID"
        yield f"GOTO/{numbers(x + 40 * i, y + 40 * j, z + 40 * k, i, j, k)}"
        yield f"CYCLE/DRILL,FEDTO,{number(-HOLE_DEPTH)},RAPTO,3,MMPM,250"
        yield f"GOTO/{numbers(x, y, z, i, j, k)}"
        yield "CYCLE/OFF"
        yield "RAPID"
        yield f"GOTO/{numbers(x + 40 * i, y + 40 * j, z + 40 * k, i, j, k)}"
    yield "END-OF-PATH"


print("\n".join(lines()))
