# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""Which simulations the paper's tables need, and what else is varied to understand them.

The paper's setting: packets of 16 rays, masked passes, tiles of 16 x 16 pixels whose end sweeps the
ray cache. Where time does not matter runs are functional; table 1 and the hardware question are
timed.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from sheaf_explore.paper.runs import Run, Scene
from sheaf_explore.parameters import Value

Settings = dict[str, Value]

STAND_INS = ("dragon", "fairy", "newtree", "oldtree", "sponza")
USUAL_SIZE = (640, 480)  # pixels

HEURISTICS = ("none", "dir", "mdir(96)", "fastpos", "pos(1.0)", "opos")
LEVELS = (1, 2, 3)
PACKET_SIZES = (4, 8, 16, 32, 64)
TRAVERSALS = {"none": "masked", "interval": "interval", "omni": "omni"}
TRAVERSAL_SCENES = ("newtree", "oldtree")
TABLE1_HEURISTICS = ("none", "dir", "fastpos", "mdir(96)", "pos(1.0)")

SWAY_LEVEL = 2


@dataclass(frozen=True)
class Variant:
    """Something that the paper does not print, set otherwise."""

    group: str
    name: str
    settings: tuple[tuple[str, Value], ...]
    only: tuple[str, ...] = HEURISTICS  # that it can change


BASE = Variant("as designed", "as designed", ())
_SORTED = tuple(h for h in HEURISTICS if h != "none")
VARIANTS = (
    BASE,
    Variant("tile", "8 × 8", (("flow.tile_size", 8),)),
    Variant("tile", "32 × 32", (("flow.tile_size", 32),)),
    Variant("tile", "64 × 64", (("flow.tile_size", 64),)),
    Variant("tree", "depth at most 16", (("kdtree.max_depth", 16),), ("none", "dir")),
    Variant("tree", "cheap tests, K_I = 5", (("kdtree.intersection_cost", 5.0),), ("none", "dir")),
    Variant("tree", "dear tests, K_I = 80", (("kdtree.intersection_cost", 80.0),), ("none", "dir")),
    Variant("tree", "no bonus for empty space", (("kdtree.empty_bonus", 1.0),), ("none", "dir")),
    Variant("order", "kinds in cells apart", (("ray_cache.group_by_kind", True),), _SORTED),
    Variant("order", "breadth first", (("ray_cache.order", "breadth_first"),)),
)

# x is in squared units of a scene, which the paper does not print either.
POS_HEURISTICS = ("pos(0.01)", "pos(0.1)", "pos(10)", "pos(100)")

# Stand-ins seen from elsewhere: what changes with the view belongs to the scene, not to the model.
VIEWS: dict[str, tuple[str, Settings]] = {
    "fairy": (
        "from farther away",
        {"camera.position": (1.2, 5.0, 16.0), "camera.look_at": (0.0, 5.0, 0.0)},
    ),
    "newtree": (
        "from above",
        {"camera.position": (4.0, 14.0, 10.0), "camera.look_at": (0.0, 3.0, 0.0)},
    ),
}


@dataclass(frozen=True)
class Machine:
    """A machine of the hardware question: how it sorts, and what memory it has."""

    heuristic: str
    cells: int
    memory: str

    @property
    def label(self) -> str:
        """The sorting in words."""
        return self.heuristic if self.heuristic == "none" else f"{self.heuristic} × {self.cells}"


HARDWARE_LEVEL = 2
HARDWARE_SCENES = ("dragon", "oldtree", "sponza")
_PERFECT = {f"{name}_cache.mode": "perfect" for name in ("node", "triangle", "attribute", "film")}
# What lies behind the pipeline, the fastest first.
MEMORIES: dict[str, Settings] = {
    "perfect caches": {**_PERFECT},
    "HBM2": {"dram.model": "HBM2-2000"},
    "DDR4": {"dram.model": "DDR4-3200"},
    "DDR4, caches an eighth": {
        "dram.model": "DDR4-3200",
        "node_cache.capacity": 2048,
        "triangle_cache.capacity": 2048,
        "attribute_cache.capacity": 2048,
        "l2.capacity": 65536,
    },
}
USUAL_MEMORY = "DDR4"  # with caches of their default size
SORTINGS = (
    ("none", 0),
    ("dir", 8),
    ("mdir(24)", 24),
    ("mdir(96)", 8),
    ("mdir(96)", 24),
    ("mdir(96)", 96),
    ("fastpos", 8),
    ("pos(1.0)", 64),
)
# Rays that credits admit: enough that rays waiting in the largest ray cache leave as many moving.
CREDITS = 8192


@dataclass(frozen=True)
class Plan:
    """All simulations, for these scenes at this size of the picture."""

    scenes: tuple[Scene, ...]
    width: int
    height: int

    def run(self, scene: Scene, asked_by: str, **changes: Value) -> Run:
        """A run of a scene; keywords are keys with two underscores for the dot."""
        return self.make(scene, asked_by, {k.replace("__", "."): v for k, v in changes.items()})

    def make(self, scene: Scene, asked_by: str, changes: Settings) -> Run:
        """A run of a scene with these settings on top of the paper's."""
        settings: Settings = {
            "image.width": self.width,
            "image.height": self.height,
            "run.fidelity": "functional",
        }
        settings |= dict(scene.settings) | changes
        return Run(scene, tuple(sorted(settings.items())), asked_by)

    # One function a table: the run behind a cell -----------------------------------------------

    def coherence(self, scene: Scene, level: int, heuristic: str, base: Variant = BASE) -> Run:
        """Table 4, figures 2 and 5, and their variants. c_t and c_i belong to no heuristic."""
        settings: Settings = {
            "render.recursion_level": level,
            "ray_cache.heuristic": heuristic,
            "measure.coherence": heuristic == "none" and base.group != "order",
        }
        what = f"{base.name}, {heuristic}, level {level}"
        return self.make(scene, what, settings | dict(base.settings))

    def packet(self, scene: Scene, size: int) -> Run:
        """Table 2, figures 6 and 7."""
        if size == 16:
            return self.coherence(scene, 1, "none")
        return self.run(scene, f"packets of {size}", ray_cache__heuristic="none", packet__size=size)

    def traversal(self, scene: Scene, scheme: str) -> Run:
        """Table 3."""
        if scheme == "masked":
            return self.coherence(scene, 1, "none")
        return self.run(scene, scheme, ray_cache__heuristic="none", traversal__scheme=scheme)

    def frame_rate(self, scene: Scene, heuristic: str) -> Run:
        """Table 1."""
        return self.run(
            scene,
            f"timed, {heuristic}",
            run__fidelity="timed",
            ray_cache__heuristic=heuristic,
        )

    def machine(self, scene: Scene, machine: Machine) -> Run:
        """The hardware question."""
        settings: Settings = {
            "run.fidelity": "timed",
            "render.recursion_level": HARDWARE_LEVEL,
            "flow.control": "credits",
            "flow.credits": CREDITS,
            "ray_cache.heuristic": machine.heuristic,
            "ray_cache.cells": machine.cells,
        }
        what = f"{machine.label}, {machine.memory}"
        return self.make(scene, what, settings | MEMORIES[machine.memory])

    # What belongs to which question ------------------------------------------------------------

    def machines(self) -> list[Machine]:
        """Every sorting with every memory."""
        return [Machine(h, cells, memory) for memory in MEMORIES for h, cells in SORTINGS]

    def hardware_scenes(self) -> list[Scene]:
        """Where machines are compared: a closed box, scattered leaves, a court."""
        return [scene for scene in self.scenes if scene.name in HARDWARE_SCENES]

    def varied_scenes(self) -> list[Scene]:
        """Where what the paper leaves open is varied: the scenes that everybody has."""
        return [scene for scene in self.scenes if not scene.real]

    def traversal_scenes(self) -> list[Scene]:
        """The scenes of table 3."""
        return [scene for scene in self.scenes if scene.stands_for in TRAVERSAL_SCENES]

    def views(self) -> Plan:
        """The same experiments on stand-ins that are seen from elsewhere."""
        scenes = []
        for scene in self.varied_scenes():
            if scene.name in VIEWS:
                where, settings = VIEWS[scene.name]
                name = f"{scene.name} {where}"
                scenes.append(replace(scene, name=name, settings=tuple(settings.items())))
        return replace(self, scenes=tuple(scenes))

    def all_runs(self) -> Iterator[Run]:
        """Everything: the slowest first, the rest in the order in which it is read."""
        for scene in reversed(self.traversal_scenes()):
            yield from (self.traversal(scene, scheme) for scheme in TRAVERSALS.values())
        for scene in (*self.scenes, *self.views().scenes):
            for level in LEVELS:
                yield from (self.coherence(scene, level, h) for h in HEURISTICS)
        for scene in self.scenes:
            yield from (self.packet(scene, size) for size in PACKET_SIZES)
            yield from (self.frame_rate(scene, h) for h in TABLE1_HEURISTICS)
        for scene in self.varied_scenes():
            for variant in VARIANTS:
                yield from (self.coherence(scene, SWAY_LEVEL, h, variant) for h in variant.only)
            yield from (self.coherence(scene, SWAY_LEVEL, h) for h in POS_HEURISTICS)
        for scene in self.hardware_scenes():
            yield from (self.machine(scene, machine) for machine in self.machines())

    def command_line(self) -> str:
        """The command that makes these runs and a page of documentation of them."""
        words = ["explore paper"]
        stand_ins = [scene.name for scene in self.scenes if not scene.real]
        if stand_ins != list(STAND_INS):
            words.append(f"--scenes {','.join(stand_ins)}")
        if (self.width, self.height) != USUAL_SIZE:
            words.append(f"--size {self.width}x{self.height}")
        words += [f"--{scene.stands_for} FILE" for scene in self.scenes if scene.real]
        return " ".join([*words, "--docs explore/docs"])
