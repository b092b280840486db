# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""explore paper: simulates what is missing and writes the report."""

from __future__ import annotations

import re
from pathlib import Path

from sheaf_explore.errors import Exit, ExploreError
from sheaf_explore.paper.page import find, write_docs, write_page
from sheaf_explore.paper.plan import Plan, STAND_INS
from sheaf_explore.paper.runs import Scene, simulate, Workshop

QUICK = (128, 96)  # pixels, for a look at the report; the numbers are not the paper's then
_REFLECTING = (("scene.reflectance", 0.5),)  # as the paper made everything half a mirror


def parse_size(text: str) -> tuple[int, int]:
    """Reads "640x480". Raises ExploreError."""
    match = re.fullmatch(r"([0-9]{1,9})[x×]([0-9]{1,9})", text.strip())
    if match is None:
        raise ExploreError(f"--size {text!r}: expected WIDTHxHEIGHT, such as 640x480")
    return int(match[1]), int(match[2])


def _folder_of_scenes() -> Path:
    """Where the committed scenes are: in the checkout of this package, or here."""
    checkout = Path(__file__).parents[4] / "scenes"
    return checkout if checkout.is_dir() else Path("scenes")


def choose_scenes(names: str, sponza: Path | None, dragon: Path | None) -> tuple[Scene, ...]:
    """The stand-ins asked for, and the paper's own models where they are given."""
    chosen = [name.strip() for name in names.split(",")] if names else list(STAND_INS)
    for name in chosen:
        if name not in STAND_INS:
            raise ExploreError(f"--scenes: no scene {name!r}; there are {', '.join(STAND_INS)}")
    folder = _folder_of_scenes()
    scenes = [Scene(name, folder / f"{name}.glb", name) for name in dict.fromkeys(chosen)]
    for name, path in (("sponza", sponza), ("dragon", dragon)):
        if path is not None:
            scenes.append(Scene(f"{name} (real)", path, name, _REFLECTING))
    for scene in scenes:
        if not scene.path.is_file():
            raise ExploreError(f"{scene.path}: is no file; the committed scenes are in scenes/")
    return tuple(scenes)


def make_paper(plan: Plan, shop: Workshop, out: Path, docs: Path | None) -> Exit:
    """Runs what has no result yet and writes the report from all that has one.

    Raises ExploreError before anything runs if the simulator does not take the size.
    """
    refusal = shop.simulator.refusal({"image.width": plan.width, "image.height": plan.height})
    if refusal is not None:
        raise ExploreError(f"--size {plan.width}x{plan.height}: {refusal}")
    runs = list(dict.fromkeys(plan.all_runs()))
    results, result = simulate(runs, shop)
    if result.tally.interrupted:
        shop.say("interrupted: the same command resumes")
        return Exit.INTERRUPTED
    seconds = shop.store.processor_seconds()
    findings = find(plan, results, len(runs), len(runs) - result.done, seconds)
    shop.say(f"report: {write_page(out, findings)}")
    if docs is not None:
        shop.say(f"page: {write_docs(docs, findings)}")
    return result.status
