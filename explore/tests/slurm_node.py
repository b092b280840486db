# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""A Slurm of one node on loopback, with its own keys, folders and ports."""

from __future__ import annotations

import contextlib
import os
import shutil
import socket
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

_CONFIGURATION = """ClusterName=sheaf
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket={folder}/munge.socket
SlurmctldPort={controller_port}
SlurmdPort={node_port}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
SwitchType=switch/none
KillWait=2
MinJobAge=2
ReturnToService=2
MailProg=/bin/true
NodeName={host} NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=main Nodes={host} Default=YES MaxTime=INFINITE State=UP OverSubscribe=FORCE:4
"""


def missing() -> str:
    """Why Slurm cannot be started here, or nothing."""
    lacking = [p for p in ("munged", "slurmctld", "slurmd", "sbatch") if shutil.which(p) is None]
    if lacking:
        return f"not installed: {', '.join(lacking)}"
    return "" if os.geteuid() == 0 else "needs root to start slurmd"


def _free_port() -> int:
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return int(s.getsockname()[1])


def _wait(what: str, ready: object, logs: Path) -> None:
    deadline = time.monotonic() + 60
    while not ready():  # type: ignore[operator]
        if time.monotonic() > deadline:
            tails = [f"{p.name}: {p.read_text()[-1500:]}" for p in logs.glob("*.log")]
            pytest.fail(f"{what} did not start\n" + "\n".join(tails))
        time.sleep(0.1)


@contextlib.contextmanager
def running_slurm(folder: Path) -> Iterator[dict[str, str]]:
    """Starts munged, slurmctld and slurmd in the foreground; gives the environment of clients."""
    host = socket.gethostname().split(".")[0]
    for name in ("state", "spool"):
        (folder / name).mkdir()
    key = folder / "munge.key"
    key.write_bytes(os.urandom(128))
    key.chmod(0o400)
    configuration = folder / "slurm.conf"
    configuration.write_text(
        _CONFIGURATION.format(
            folder=folder, host=host, controller_port=_free_port(), node_port=_free_port()
        )
    )
    environment = os.environ | {"SLURM_CONF": str(configuration)}
    munge = ["munged", "--foreground", "--force", f"--key-file={key}"]
    munge += [f"--{part}-file={folder}/munge.{part}" for part in ("pid", "log", "seed")]
    munge += [f"--socket={folder}/munge.socket", "--num-threads=1"]
    daemons: list[subprocess.Popen[bytes]] = []

    def start(*words: str) -> None:
        with (folder / f"{words[0]}.out.log").open("wb") as log:
            daemons.append(subprocess.Popen(words, env=environment, stdout=log, stderr=log))

    def node_is_idle() -> bool:
        words = ["sinfo", "--noheader", "--format=%T"]
        done = subprocess.run(words, env=environment, capture_output=True, text=True, check=False)
        return "idle" in done.stdout

    try:
        start(*munge)
        _wait("munged", (folder / "munge.socket").exists, folder)
        start("slurmctld", "-D", "-f", str(configuration))
        start("slurmd", "-D", "-f", str(configuration), "-N", host)
        _wait("slurmd", node_is_idle, folder)
        yield environment
    finally:
        with contextlib.suppress(OSError, subprocess.TimeoutExpired):
            subprocess.run(["scancel", "--user=root"], env=environment, timeout=10, check=False)
            _jobs_gone(environment)
        for daemon in reversed(daemons):
            daemon.terminate()
        for daemon in daemons:
            try:
                daemon.wait(timeout=15)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()


def jobs(environment: dict[str, str], state: str = "R") -> list[str]:
    """Numbers of the jobs in a state."""
    words = ["squeue", "--noheader", "--format=%i", f"--states={state}"]
    done = subprocess.run(words, env=environment, capture_output=True, text=True, check=False)
    return done.stdout.split()


def _jobs_gone(environment: dict[str, str]) -> None:
    deadline = time.monotonic() + 15
    while jobs(environment, "all") and time.monotonic() < deadline:
        time.sleep(0.1)
