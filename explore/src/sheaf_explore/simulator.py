# SPDX-FileCopyrightText: 2026 The Sheaf authors
# SPDX-License-Identifier: Apache-2.0
"""The simulator as the sweep sees it: where it is, what it takes, what it is."""

from __future__ import annotations

import hashlib
import json
import os
import re
import shutil
import subprocess
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from sheaf_explore.errors import ExploreError
from sheaf_explore.gltf_files import referred_files
from sheaf_explore.parameters import Parameters, Value
from sheaf_explore.spec import Source

_CHUNK = 1 << 20


def hash_file(path: Path) -> str:
    """SHA-256 of a file's bytes."""
    digest = hashlib.sha256()
    with path.open("rb") as stream:
        while chunk := stream.read(_CHUNK):
            digest.update(chunk)
    return digest.hexdigest()


def hash_source(source: Source) -> str:
    """SHA-256 of a scene or trace with every file that a scene refers to."""
    own = hash_file(source.path)
    parts = referred_files(source.path) if source.kind == "scene" else []
    if not parts:
        return own
    digest = hashlib.sha256(own.encode())
    for part in parts:
        digest.update(f"{_hash_if_there(part)}\0".encode())
    return digest.hexdigest()


def _hash_if_there(path: Path) -> str:
    try:
        return hash_file(path) if path.is_file() else ""
    except (OSError, ValueError):  # no name of a file at all, or one that may not be read
        return ""


@dataclass(frozen=True)
class Simulator:
    """A sheaf binary."""

    path: Path
    _options: dict[str, frozenset[str]] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )

    @cached_property
    def hash(self) -> str:
        return hash_file(self.path)

    @cached_property
    def parameters(self) -> Parameters:
        text = self._ask("config", "--schema")
        try:
            return Parameters(json.loads(text))
        except (ValueError, AttributeError, TypeError):
            raise ExploreError(f"{self.path}: `config --schema` gave no JSON schema") from None

    @cached_property
    def commands(self) -> frozenset[str]:
        """Subcommands of this binary."""
        return frozenset(re.findall(r"^  (\w+)", self._ask("--help"), re.MULTILINE))

    def options(self, command: str) -> frozenset[str]:
        """Long options of a subcommand."""
        if command not in self._options:
            text = self._ask(command, "--help")
            self._options[command] = frozenset(re.findall(r"--[\w-]+", text))
        return self._options[command]

    def arguments(self, source: Source, settings: dict[str, Value], cache: Path) -> list[str]:
        """The command line that simulates one point, without its folder."""
        command = "run" if source.kind == "scene" else "replay"
        words = [str(self.path), command, str(source.path), *self._settings(settings)]
        return words + self._cache(command, cache)

    def recording(self, source: Source, settings: dict[str, Value], cache: Path) -> list[str]:
        """The command line that records the rays of a scene."""
        return [*self.arguments(source, settings, cache), "--record", "rays"]

    def replaying(
        self, trace: Path, source: Source, settings: dict[str, Value], cache: Path
    ) -> list[str]:
        """The command line that replays such a recording on another machine."""
        words = [str(self.path), "replay", str(trace), "--scene", str(source.path)]
        return words + self._settings(settings) + self._cache("replay", cache)

    def _settings(self, settings: dict[str, Value]) -> list[str]:
        words = []
        for key in sorted(settings):
            words += ["--set", f"{key}={self.parameters[key].text(settings[key])}"]
        return words

    def _cache(self, command: str, cache: Path) -> list[str]:
        return ["--cache", str(cache)] if "--cache" in self.options(command) else []

    @property
    def records(self) -> bool:
        """Whether this binary can record rays and replay them."""
        return "replay" in self.commands and "--record" in self.options("run")

    def check_replay(self, sources: tuple[Source, ...]) -> None:
        """Raises ExploreError if there are traces and this binary cannot replay them."""
        traces = [source.name for source in sources if source.kind == "trace"]
        if traces and "replay" not in self.commands:
            raise ExploreError(f"{self.path} cannot replay {traces[0]}: it has no command `replay`")

    def refusal(self, settings: dict[str, Value]) -> str | None:
        """Why the simulator refuses these settings, or None if it takes them."""
        words = [str(self.path), "config", "--resolve", *self._settings(settings)]
        done = subprocess.run(words, capture_output=True, text=True, timeout=60, check=False)
        if done.returncode == 0:
            return None
        return done.stderr.strip().removeprefix("sheaf: ") or f"exit status {done.returncode}"

    def _ask(self, *arguments: str) -> str:
        try:
            done = subprocess.run(
                [str(self.path), *arguments],
                capture_output=True,
                text=True,
                timeout=60,
                check=False,
            )
        except (OSError, subprocess.TimeoutExpired) as error:
            raise ExploreError(f"{self.path}: cannot be run: {error}") from None
        if done.returncode != 0:
            raise ExploreError(f"{self.path}: `{' '.join(arguments)}` failed; is this sheaf?")
        return done.stdout


def find_simulator(given: Path | None) -> Simulator:
    """The binary given, or of $SHEAF, or on the path, or in a build folder of the checkout."""
    if given is not None or "SHEAF" in os.environ:
        path = (given or Path(os.environ["SHEAF"])).resolve()
        if not path.is_file() or not os.access(path, os.X_OK):
            raise ExploreError(f"{path}: is no program; name the simulator with --sheaf")
        return Simulator(path)
    checkout = Path(__file__).parents[3]
    candidates = [shutil.which("sheaf"), checkout / "build/release/sheaf", "build/release/sheaf"]
    for candidate in candidates:
        if candidate is not None and os.access(candidate, os.X_OK):
            return Simulator(Path(candidate).resolve())
    raise ExploreError("no simulator found; build it (./run-demo) or name it with --sheaf")
