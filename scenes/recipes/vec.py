# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Vectors, rotations and noise that give the same bits on every machine.

The scenes are compared byte for byte, so nothing here may depend on the C library or on the
version of Python. IEEE 754 fixes + - * / and sqrt to the last bit; it does not fix sin, cos, exp
or pow, which differ between C libraries. Hence the polynomial below, no `**`, and no `sum()` or
`math.hypot()` of floats either: Python 3.12 changed how the first rounds, 3.10 the second.
"""

from __future__ import annotations

from math import floor, sqrt

Vec3 = tuple[float, float, float]
Quat = tuple[float, float, float, float]

ORIGIN: Vec3 = (0.0, 0.0, 0.0)
X_AXIS: Vec3 = (1.0, 0.0, 0.0)
Y_AXIS: Vec3 = (0.0, 1.0, 0.0)
Z_AXIS: Vec3 = (0.0, 0.0, 1.0)

_HALF_PI = 1.5707963267948966


def add(a: Vec3, b: Vec3) -> Vec3:
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a: Vec3, b: Vec3) -> Vec3:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def mul(a: Vec3, s: float) -> Vec3:
    return (a[0] * s, a[1] * s, a[2] * s)


def along(start: Vec3, direction: Vec3, distance: float) -> Vec3:
    return (
        start[0] + direction[0] * distance,
        start[1] + direction[1] * distance,
        start[2] + direction[2] * distance,
    )


def mix(a: Vec3, b: Vec3, t: float) -> Vec3:
    return (a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t, a[2] + (b[2] - a[2]) * t)


def dot(a: Vec3, b: Vec3) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vec3, b: Vec3) -> Vec3:
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def length(a: Vec3) -> float:
    return sqrt(dot(a, a))


def unit(a: Vec3) -> Vec3:
    return mul(a, 1.0 / length(a))


def perpendicular(direction: Vec3) -> Vec3:
    """Some unit vector at right angles to `direction`."""
    helper = X_AXIS if abs(direction[0]) < 0.6 else Y_AXIS
    return unit(cross(direction, helper))


def cos_sin(turns: float) -> tuple[float, float]:
    """Cosine and sine of an angle in full turns; exact at quarter turns."""
    quarter = floor(turns * 4.0 + 0.5)
    x = (turns * 4.0 - quarter) * _HALF_PI
    z = x * x
    c = 1.0 - z / 2.0 * (
        1.0 - z / 12.0 * (1.0 - z / 30.0 * (1.0 - z / 56.0 * (1.0 - z / 90.0 * (1.0 - z / 132.0))))
    )
    s = x * (
        1.0 - z / 6.0 * (1.0 - z / 20.0 * (1.0 - z / 42.0 * (1.0 - z / 72.0 * (1.0 - z / 110.0))))
    )
    return ((c, s), (-s, c), (-c, -s), (s, -c))[quarter % 4]


def cosine(turns: float) -> float:
    return cos_sin(turns)[0]


def sine(turns: float) -> float:
    return cos_sin(turns)[1]


def smoothstep(low: float, high: float, x: float) -> float:
    t = min(1.0, max(0.0, (x - low) / (high - low)))
    return t * t * (3.0 - 2.0 * t)


def rotate_about(v: Vec3, axis: Vec3, turns: float) -> Vec3:
    """`v` turned about the unit vector `axis` (Rodrigues)."""
    c, s = cos_sin(turns)
    return add(add(mul(v, c), mul(cross(axis, v), s)), mul(axis, dot(axis, v) * (1.0 - c)))


def quat_about(axis: Vec3, turns: float) -> Quat:
    c, s = cos_sin(turns * 0.5)
    return (axis[0] * s, axis[1] * s, axis[2] * s, c)


def quat_from_axes(x: Vec3, y: Vec3, z: Vec3) -> Quat:
    """The rotation that carries the world's axes to the orthonormal x, y, z."""
    trace = x[0] + y[1] + z[2]
    if trace > 0.0:
        s = 2.0 * sqrt(1.0 + trace)
        return ((y[2] - z[1]) / s, (z[0] - x[2]) / s, (x[1] - y[0]) / s, s / 4.0)
    if x[0] >= y[1] and x[0] >= z[2]:
        s = 2.0 * sqrt(1.0 + x[0] - y[1] - z[2])
        return (s / 4.0, (y[0] + x[1]) / s, (z[0] + x[2]) / s, (y[2] - z[1]) / s)
    if y[1] >= z[2]:
        s = 2.0 * sqrt(1.0 + y[1] - x[0] - z[2])
        return ((y[0] + x[1]) / s, s / 4.0, (z[1] + y[2]) / s, (z[0] - x[2]) / s)
    s = 2.0 * sqrt(1.0 + z[2] - x[0] - y[1])
    return ((z[0] + x[2]) / s, (z[1] + y[2]) / s, s / 4.0, (x[1] - y[0]) / s)


def quat_look(eye: Vec3, target: Vec3) -> Quat:
    """Rotation of a glTF camera, which looks along -z with +y up."""
    back = unit(sub(eye, target))
    right = unit(cross(Y_AXIS, back))
    return quat_from_axes(right, cross(back, right), back)


def spline(points: list[Vec3], samples: int) -> list[Vec3]:
    """`samples` points along the Catmull-Rom curve through `points`, both ends included."""
    return [spline_at(points, i / (samples - 1)) for i in range(samples)]


def spline_at(points: list[Vec3], t: float) -> Vec3:
    """The point at t in [0, 1] of the Catmull-Rom curve through `points`."""
    last = len(points) - 1
    i = min(last - 1, max(0, floor(t * last)))
    f = t * last - i
    p1, p2 = points[i], points[i + 1]
    p0 = points[i - 1] if i > 0 else along(p1, sub(p2, p1), -1.0)
    p3 = points[i + 2] if i + 2 <= last else along(p2, sub(p2, p1), 1.0)
    w0 = f * (f * (1.0 - 0.5 * f) - 0.5)
    w1 = 1.0 + f * f * (1.5 * f - 2.5)
    w2 = f * (0.5 + f * (2.0 - 1.5 * f))
    w3 = f * f * (0.5 * f - 0.5)
    return add(add(mul(p0, w0), mul(p1, w1)), add(mul(p2, w2), mul(p3, w3)))


def profile_at(values: list[float], t: float) -> float:
    """The same curve through plain numbers: a radius along a body, say."""
    return spline_at([(value, 0.0, 0.0) for value in values], t)[0]


def _lattice(x: int, y: int) -> float:
    """A number in [0, 1) for a lattice point, by integer mixing."""
    h = (x * 0x9E3779B1 + y * 0x85EBCA77) & 0xFFFFFFFF
    h = ((h ^ (h >> 15)) * 0x2C1B3C6D) & 0xFFFFFFFF
    h = ((h ^ (h >> 12)) * 0x297A2D39) & 0xFFFFFFFF
    return (h ^ (h >> 15)) / 4294967296.0


def noise(x: float, y: float) -> float:
    """Smooth value noise in [0, 1) with features of size one."""
    i, j = floor(x), floor(y)
    u, v = smoothstep(0.0, 1.0, x - i), smoothstep(0.0, 1.0, y - j)
    low = _lattice(i, j) + (_lattice(i + 1, j) - _lattice(i, j)) * u
    high = _lattice(i, j + 1) + (_lattice(i + 1, j + 1) - _lattice(i, j + 1)) * u
    return low + (high - low) * v
