# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Four dragons in a Cornell box: one dense curved mesh, four nodes that share it."""

from __future__ import annotations

from itertools import pairwise
from math import floor

from recipes.glb import GlbWriter, MeshHandle
from recipes.mesh import (
    Mesh,
    box,
    cone,
    ellipsoid,
    frames,
    joined,
    quad,
    ring,
    sheet,
    skin,
    sweep,
)
from recipes.vec import (
    Y_AXIS,
    Vec3,
    add,
    along,
    mix,
    mul,
    profile_at,
    quat_about,
    sine,
    smoothstep,
    spline,
    spline_at,
)

BODY_RINGS = 93
BODY_SIDES = 36

# From the tip of the tail to the back of the head: x forward, y up.
SPINE: list[Vec3] = [
    (-1.35, 0.55, 1.35),
    (-1.9, 0.16, 1.2),
    (-2.45, 0.1, 0.55),
    (-2.3, 0.16, -0.2),
    (-1.65, 0.45, -0.5),
    (-0.95, 0.85, -0.15),
    (-0.25, 1.0, 0.2),
    (0.45, 1.05, 0.12),
    (1.0, 1.35, -0.12),
    (1.2, 1.85, -0.2),
    (1.2, 2.35, -0.08),
    (1.5, 2.68, 0.0),
]
GIRTH = [0.03, 0.08, 0.13, 0.19, 0.28, 0.42, 0.47, 0.48, 0.38, 0.26, 0.22, 0.22]


def scales(row: float, turn: float) -> float:
    """Rows of overlapping scales, each row shifted by half of one; 0 to 1."""
    line = floor(row)
    column = turn * 9.0 + 0.5 * (line % 2)
    across = (column - floor(column)) * 2.0 - 1.0
    down = row - line
    return (1.0 - across * across) * (1.0 - down)


def body() -> Mesh:
    """The trunk: scales on the back, broad plates on the belly."""
    path = spline(SPINE, BODY_RINGS)
    rings = []
    for j, frame in enumerate(frames(path, Y_AXIS)):
        t = j / (BODY_RINGS - 1)
        girth = profile_at(GIRTH, t)

        def radius(turn: float, t: float = t, girth: float = girth) -> float:
            belly = smoothstep(0.3, 0.42, turn) * (1.0 - smoothstep(0.58, 0.7, turn))
            plates = t * 23.0 - floor(t * 23.0)
            ridge = smoothstep(0.08, 0.0, min(turn, 1.0 - turn))
            relief = 0.13 * scales(t * 23.0, turn) * (1.0 - belly) + 0.07 * plates * belly
            return girth * (1.0 + relief + 0.22 * ridge - 0.1 * belly)

        rings.append(ring(path[j], frame, BODY_SIDES, radius))
    return skin(rings, path[0], path[-1])


def spikes() -> Mesh:
    """A crest of thorns along the back, the largest between the shoulders."""
    path = spline(SPINE, 31)
    crest = []
    for j, (up, _, forward) in enumerate(frames(path, Y_AXIS)):
        if j == 0 or j == len(path) - 1:
            continue
        girth = profile_at(GIRTH, j / (len(path) - 1))
        size = 0.12 + 0.62 * girth
        root = along(path[j], up, girth * 0.95)
        bend = along(along(root, up, size * 0.6), forward, -size * 0.2)
        tip = along(along(root, up, size), forward, -size * 0.6)
        radii = [size * share for share in (0.24, 0.17, 0.09, 0.0)]
        crest.append(sweep(spline([root, bend, tip], 4), radii, 6))
    return joined(crest)


def leg(hip: Vec3, knee: Vec3, ankle: Vec3, foot: Vec3, thick: float) -> tuple[Mesh, Mesh]:
    """A leg with three toes, and its claws apart."""
    path = spline([hip, knee, ankle, foot], 15)
    girth = [thick, thick * 0.95, thick * 0.42, thick * 0.46]
    radii = [profile_at(girth, i / 14) for i in range(15)]
    parts, claws = [sweep(path, radii, 14)], []
    for side in (-1.0, 0.0, 1.0):
        reach = (0.34 - 0.06 * abs(side), -foot[1] + 0.045, side * 0.17)
        toe_end = add(foot, reach)
        middle = add(mix(foot, toe_end, 0.55), (0.0, 0.06, 0.0))
        toe = spline([foot, middle, toe_end], 6)
        parts.append(sweep(toe, [0.08, 0.085, 0.08, 0.075, 0.07, 0.05], 8))
        tip = add(toe_end, (0.17, -0.035, side * 0.06))
        claws.append(cone(along(toe_end, reach, -0.1), tip, 0.045, 7))
    return joined(parts), joined(claws)


def legs() -> tuple[Mesh, Mesh]:
    """Hind legs and forelegs, one of which steps forward."""
    pairs = [
        leg((-0.75, 0.9, 0.25), (-0.5, 0.72, 0.72), (-0.95, 0.3, 0.8), (-0.8, 0.1, 0.82), 0.27),
        leg((-0.85, 0.85, -0.4), (-0.75, 0.7, -0.85), (-1.2, 0.3, -0.92), (-1.1, 0.1, -0.94), 0.27),
        leg((0.62, 1.05, 0.3), (0.55, 0.8, 0.66), (0.75, 0.35, 0.68), (0.85, 0.1, 0.68), 0.21),
        leg((0.8, 1.1, -0.3), (0.85, 0.85, -0.66), (1.2, 0.45, -0.66), (1.4, 0.1, -0.64), 0.21),
    ]
    return joined([limb for limb, _ in pairs]), joined([claws for _, claws in pairs])


def head() -> tuple[Mesh, Mesh]:
    """A long-jawed head with its mouth open, and its teeth, horns and eyes apart."""
    upper = spline([(1.38, 2.62, 0.0), (1.7, 2.78, 0.0), (2.1, 2.72, 0.0), (2.52, 2.62, 0.0)], 16)
    lower = spline([(1.45, 2.56, 0.0), (1.7, 2.46, 0.0), (2.0, 2.33, 0.0), (2.3, 2.26, 0.0)], 12)
    brow = [0.2, 0.29, 0.22, 0.17, 0.11]
    jaw = [0.16, 0.17, 0.12, 0.07]
    flesh = [
        sweep(upper, [profile_at(brow, i / 15) for i in range(16)], 20, Y_AXIS),
        sweep(lower, [profile_at(jaw, i / 11) for i in range(12)], 16, Y_AXIS),
    ]
    bone = []
    for side in (-1.0, 1.0):
        flesh.append(ellipsoid((1.76, 2.96, side * 0.15), (0.12, 0.09, 0.09), 6, 10))
        flesh.append(ellipsoid((2.47, 2.72, side * 0.07), (0.06, 0.05, 0.045), 5, 8))
        bone.append(ellipsoid((1.83, 2.91, side * 0.2), (0.055, 0.06, 0.05), 6, 8))
        horn = [(1.52, 2.86, 0.15), (1.25, 3.12, 0.26), (0.92, 3.2, 0.36), (0.62, 3.42, 0.36)]
        path = spline([(x, y, z * side) for x, y, z in horn], 9)
        bone.append(sweep(path, [0.1 * (1.0 - i / 8.0) for i in range(9)], 10))
        for k in range(6):
            root = spline_at(upper, 0.5 + 0.085 * k)
            gum = add(root, (0.0, -0.1 + 0.008 * k, side * (0.12 - 0.014 * k)))
            bone.append(cone(gum, add(gum, (-0.01, -0.13, 0.0)), 0.03, 5))
        for k in range(3):
            root = (1.5 - 0.03 * k, 2.62 - 0.1 * k, side * 0.17)
            bone.append(cone(root, add(root, (-0.3, 0.08 - 0.1 * k, side * 0.2)), 0.05, 6))
    return joined(flesh), joined(bone)


def wing() -> tuple[Mesh, Mesh]:
    """The right wing: fingers of bone, a membrane that sags between them."""
    shoulder: Vec3 = (0.35, 1.35, 0.3)
    wrist: Vec3 = (0.25, 2.35, 0.95)
    tips: list[Vec3] = [
        (0.7, 3.35, 1.5),
        (-0.45, 3.2, 1.85),
        (-1.2, 2.55, 1.75),
        (-1.45, 1.85, 1.25),
        (-0.75, 1.2, 0.42),
    ]
    arm = spline([shoulder, (0.2, 1.85, 0.75), wrist], 7)
    bones = [sweep(arm, [0.11, 0.1, 0.09, 0.08, 0.075, 0.075, 0.06], 8)]
    fingers = []
    for tip in tips[:4]:
        knuckle = add(mix(wrist, tip, 0.5), (0.06, 0.12, 0.1))
        finger = spline([wrist, knuckle, tip], 8)
        fingers.append(finger)
        bones.append(sweep(finger, [0.05 - 0.006 * i for i in range(7)] + [0.0], 7))
    fingers.append(spline([wrist, (0.1, 1.7, 0.55), tips[4]], 8))
    webs = [web(a, b) for a, b in pairwise(fingers)]
    return joined(bones), joined(webs)


def web(a: list[Vec3], b: list[Vec3]) -> Mesh:
    """Skin between two fingers; its free edge is scalloped."""
    rows = []
    for i in range(7):
        u = i / 6.0
        slack = sine(u * 0.5)
        row = []
        for k in range(1, len(a)):
            v = k / (len(a) - 1) * (1.0 - 0.2 * slack)
            flat = mix(spline_at(a, v), spline_at(b, v), u)
            row.append(add(flat, mul((0.05, 0.02, -0.14), slack * v)))
        rows.append(row)
    return sheet(rows, 0.016)


def dragon_parts() -> tuple[Mesh, Mesh, Mesh]:
    """Hide, horn and wing skin of one dragon."""
    limbs, claws = legs()
    face, horns = head()
    bones, webs = wing()
    hide = joined([body(), limbs, face, bones, bones.mirrored_z()])
    horn = joined([spikes(), claws, horns])
    return hide.smoothed(), horn.smoothed(), joined([webs, webs.mirrored_z()]).smoothed()


def walls(scene: GlbWriter) -> None:
    """The box, open towards the camera, and two blocks."""
    x, y, z = 5.0, 6.9, 5.0
    white = scene.material("white", (0.75, 0.75, 0.72))
    red = scene.material("red", (0.75, 0.12, 0.1))
    green = scene.material("green", (0.14, 0.6, 0.16))
    floor_ = quad((-x, 0.0, z), (x, 0.0, z), (x, 0.0, -z), (-x, 0.0, -z))
    ceiling = quad((-x, y, -z), (x, y, -z), (x, y, z), (-x, y, z))
    back = quad((-x, 0.0, -z), (x, 0.0, -z), (x, y, -z), (-x, y, -z))
    left = quad((-x, 0.0, z), (-x, 0.0, -z), (-x, y, -z), (-x, y, z))
    right = quad((x, 0.0, -z), (x, 0.0, z), (x, y, z), (x, y, -z))
    blocks = [
        box((-4.6, 0.0, -4.4), (-0.5, 2.1, -0.7)),
        box((0.5, 0.0, -4.4), (4.6, 1.4, -0.7)),
    ]
    parts = [(joined([floor_, ceiling, back, *blocks]), white), (left, red), (right, green)]
    scene.place(scene.mesh("box", parts), "box")


def place_four(scene: GlbWriter, dragon: MeshHandle) -> None:
    """Two on the blocks, two on the floor."""
    scene.place(dragon, "dragon 1", (-2.3, 2.1, -2.6), quat_about(Y_AXIS, 0.93), (0.95, 0.95, 0.95))
    scene.place(dragon, "dragon 2", (2.5, 1.4, -2.6), quat_about(Y_AXIS, 0.6), (0.95, 0.95, 0.95))
    scene.place(dragon, "dragon 3", (-2.2, 0.0, 2.0), quat_about(Y_AXIS, 0.88), (1.0, 1.0, 1.0))
    # The mirrored one: a negative scale turns the winding over.
    scene.place(dragon, "dragon 4", (2.2, 0.0, 1.8), quat_about(Y_AXIS, 0.1), (-1.0, 1.0, 1.0))


def look(scene: GlbWriter) -> None:
    """Camera and light."""
    scene.camera((0.0, 4.2, 14.4), (0.0, 2.85, 0.0), 0.6)
    scene.point_light((0.0, 6.1, 4.2), (1.0, 0.95, 0.85), 190.0)


def build() -> GlbWriter:
    scene = GlbWriter("dragon")
    walls(scene)
    hide = scene.material("hide", (0.85, 0.62, 0.2))
    horn = scene.material("horn", (0.9, 0.88, 0.8))
    skin_ = scene.material("wing", (0.7, 0.2, 0.15))
    meshes = dragon_parts()
    place_four(scene, scene.mesh("dragon", list(zip(meshes, (hide, horn, skin_), strict=True))))
    look(scene)
    return scene
