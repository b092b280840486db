# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""The explore command."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import Annotated

import typer

from sheaf_explore.errors import Exit, ExploreError

_EXITS = (
    "Exit statuses: 0 done; 1 some points failed; 2 spec or command refused; 3 cluster not there or"
    " lost; 4 result not written; 130 interrupted, the same command resumes."
)

_PROCESSORS = len(os.sched_getaffinity(0))

app = typer.Typer(
    add_completion=False,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    help="Design sweeps over the machines that Sheaf simulates.",
    epilog=_EXITS,
)

SpecFile = Annotated[Path, typer.Argument(metavar="SPEC.toml", help="What to sweep")]
SweepFolder = Annotated[Path, typer.Argument(metavar="SWEEP", help="Folder of a sweep")]
Out = Annotated[
    Path | None, typer.Option("--out", help="Folder of the sweep (default sweeps/<SPEC>)")
]
Sheaf = Annotated[
    Path | None,
    typer.Option("--sheaf", help="The simulator (default $SHEAF, the path, build/release/sheaf)"),
]
Workers = Annotated[
    int, typer.Option("--workers", "-j", min=1, help="Points at a time (default: one a processor)")
]
Processes = Annotated[
    bool, typer.Option("--processes", help="Local workers as processes instead of threads")
]
Scheduler = Annotated[
    str | None, typer.Option("--scheduler", help="Address of a running Dask scheduler")
]
SchedulerFile = Annotated[
    Path | None, typer.Option("--scheduler-file", help="File that tells the address")
]
Slurm = Annotated[
    Path | None, typer.Option("--slurm", help="Profile (TOML) of the Slurm jobs to run")
]
Cache = Annotated[
    Path | None,
    typer.Option("--cache", help="Where runs share kd-trees, or none (default ~/.cache/sheaf)"),
]


def _say(text: str) -> None:
    print(text, file=sys.stderr, flush=True)


@app.command(epilog=_EXITS)
def sweep(
    spec: SpecFile,
    out: Out = None,
    sheaf: Sheaf = None,
    workers: Workers = _PROCESSORS,
    processes: Processes = False,
    scheduler: Scheduler = None,
    scheduler_file: SchedulerFile = None,
    slurm: Slurm = None,
    cache: Cache = None,
    dry_run: Annotated[
        bool, typer.Option("--dry-run", help="List the points and estimate the time they need")
    ] = False,
    probes: Annotated[
        int, typer.Option("--probes", min=0, help="Points that --dry-run simulates; 0 for none")
    ] = 3,
) -> None:
    """Simulate every point of a spec; run again, it goes on where it stopped."""
    from sheaf_explore import sweep as work
    from sheaf_explore.cluster import ClusterChoice
    from sheaf_explore.listing import list_points
    from sheaf_explore.simulator import find_simulator
    from sheaf_explore.store import Store

    simulator = find_simulator(sheaf)
    loaded = work.load_spec(spec, simulator)
    folder = out or Path("sweeps") / spec.stem
    choice = ClusterChoice(workers, processes, scheduler, scheduler_file, slurm)
    store = Store(folder)
    with store.opened():
        planned = work.plan_sweep(loaded, simulator, store, cache or work.cache_folder())
        if dry_run:
            list_points(planned)
            result = work.probe(planned, choice, probes, _say)
        else:
            result = work.run_sweep(planned, choice, _say)
            _say(work.summary(result, folder))
    raise typer.Exit(result.status)


@app.command(epilog=_EXITS)
def collect(folder: SweepFolder) -> None:
    """Gather all points into SWEEP/results.parquet and results.csv, one row each."""
    from sheaf_explore.collect import collect as gather
    from sheaf_explore.store import Store

    table = gather(Store(folder))
    path = table.write(folder)
    _say(f"{len(table.frame)} points, {len(table.frame.columns)} columns: {path}")


@app.command(epilog=_EXITS)
def report(folder: SweepFolder) -> None:
    """Make SWEEP/report: one HTML page that needs no network, and each plot as PNG and SVG."""
    from sheaf_explore.report import write_report
    from sheaf_explore.store import Store

    _say(f"report: {write_report(Store(folder))}")


@app.command(epilog=_EXITS)
def optimize(
    spec: SpecFile,
    out: Out = None,
    sheaf: Sheaf = None,
    workers: Workers = _PROCESSORS,
    processes: Processes = False,
    scheduler: Scheduler = None,
    scheduler_file: SchedulerFile = None,
    slurm: Slurm = None,
    cache: Cache = None,
    budget: Annotated[
        int | None, typer.Option("--budget", min=2, help="Runs (default: what the spec says)")
    ] = None,
) -> None:
    """Find the Pareto front of a large space: search with cheap runs, confirm with dear ones."""
    from sheaf_explore import sweep as work
    from sheaf_explore.cluster import ClusterChoice
    from sheaf_explore.optimize import optimize as search
    from sheaf_explore.simulator import find_simulator
    from sheaf_explore.store import Store

    simulator = find_simulator(sheaf)
    loaded = work.load_spec(spec, simulator)
    folder = out or Path("sweeps") / f"{spec.stem}-optimize"
    choice = ClusterChoice(workers, processes, scheduler, scheduler_file, slurm)
    status = search(
        loaded, simulator, Store(folder), cache or work.cache_folder(), choice, budget, _say
    )
    raise typer.Exit(status)


@app.command(epilog=_EXITS)
def trace(
    file: Annotated[Path, typer.Argument(metavar="TRACE", help="What sheaf run --record wrote")],
    parquet: Annotated[
        Path | None, typer.Option("--parquet", help="Folder for its tables as Parquet files")
    ] = None,
) -> None:
    """Tell what a trace holds, or write its tables for pandas and others."""
    from sheaf_explore.traces import Trace, write_parquet

    opened = Trace(file)
    if parquet is None:
        print(f"{opened.kind} of {opened.metadata['scene']['name']}: {opened.records} records")
        return
    for path in write_parquet(opened, parquet):
        _say(f"written: {path}")


@app.command(epilog=_EXITS)
def paper(
    out: Annotated[Path, typer.Option("--out", help="Folder of the runs and the report")] = Path(
        "result/paper"
    ),
    scenes: Annotated[
        str, typer.Option("--scenes", help="Some of dragon,fairy,newtree,oldtree,sponza")
    ] = "",
    size: Annotated[str, typer.Option("--size", help="Pixels of the picture")] = "640x480",
    quick: Annotated[
        bool, typer.Option("--quick", help="Small pictures: for a look, not for numbers")
    ] = False,
    sponza: Annotated[
        Path | None, typer.Option("--sponza", help="The real Sponza (.glb), to compare it too")
    ] = None,
    dragon: Annotated[
        Path | None,
        typer.Option("--dragon", help="A scene with the real dragon, to compare it too"),
    ] = None,
    docs: Annotated[
        Path | None, typer.Option("--docs", help="Write paper.md with its images here, too")
    ] = None,
    sheaf: Sheaf = None,
    workers: Workers = _PROCESSORS,
    cache: Cache = None,
) -> None:
    """Make the experiments of "Deep Coherent Ray Tracing" again, beside what the paper prints."""
    from sheaf_explore import sweep as work
    from sheaf_explore.cluster import ClusterChoice
    from sheaf_explore.paper import command
    from sheaf_explore.paper.plan import Plan
    from sheaf_explore.paper.runs import Workshop
    from sheaf_explore.simulator import find_simulator
    from sheaf_explore.store import Store

    width, height = command.QUICK if quick else command.parse_size(size)
    plan = Plan(command.choose_scenes(scenes, sponza, dragon), width, height)
    shop = Workshop(
        find_simulator(sheaf),
        Store(out / "runs"),
        cache or work.cache_folder(),
        ClusterChoice(workers),
        _say,
    )
    raise typer.Exit(command.make_paper(plan, shop, out, docs))


def main() -> None:
    """Runs the command; what the user can mend ends it with one line."""
    try:
        app()
    except ExploreError as error:
        _say(f"explore: {error}")
        sys.exit(error.status)
    except KeyboardInterrupt:
        _say("explore: interrupted; the same command resumes")
        sys.exit(Exit.INTERRUPTED)


if __name__ == "__main__":
    main()
