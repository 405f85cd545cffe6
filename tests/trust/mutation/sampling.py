"""Mutants of a group, a sample of each module by seed, run and judged."""

from __future__ import annotations

import importlib
import json
import logging
import random
from dataclasses import asdict, dataclass
from pathlib import Path

import pytest

from tests.trust.mutation.forks import Forks
from tests.trust.mutation.groups import GROUPS, ROOT, Group
from tests.trust.mutation.mutants import Mutant, mutants_of

LOG = logging.getLogger(__name__)
SAMPLE, SEED = 12, 1
"""mutants of each module, and the seed that picks them"""


@dataclass(frozen=True)
class Survivor:
    """A mutant that no test noticed.

    reached : whether a test runs its lines
    """

    module: str
    line: int
    text: str
    change: str
    reached: bool


@dataclass(frozen=True)
class Judged:
    """What became of the mutants of a group.

    whole : whether all tests were run; where not, what they had noticed by then
    """

    modules: int
    mutants: int
    killed: int
    survivors: tuple[Survivor, ...]
    left_out: tuple[str, ...]
    whole: bool


def sampled(group: Group, sample: int, seed: int) -> list[Mutant]:
    """Mutants of the modules of a group, each module by itself."""
    chosen: list[Mutant] = []
    for path in group.files():
        mutants = mutants_of(path, path.read_text(encoding="utf-8"))
        picked = random.Random(f"{seed} {path.name}").sample(range(len(mutants)), min(sample, len(mutants)))
        chosen += [mutants[at] for at in sorted(picked)]
    return chosen


def judged(group: Group, mutants: list[Mutant]) -> Judged:
    """Run the tests of a group against its mutants, in this process and forks of it."""
    files = group.files()
    for path in files:
        importlib.import_module(module_name(path))
    forks = Forks(mutants, group.longest)
    tests = ["-q", "-p", "no:cacheprovider", "-m", "not long and not trust", *map(str, group.test_files())]
    for forks.last_turn in (False, True):
        status = pytest.main(tests, plugins=[forks])
        if status not in (pytest.ExitCode.OK, pytest.ExitCode.TESTS_FAILED, pytest.ExitCode.INTERRUPTED):
            raise RuntimeError(f"pytest ended with {status}")
        if status == pytest.ExitCode.INTERRUPTED:
            break
        LOG.info("%d of %d mutants live", len(forks.alive), len(mutants))
    return Judged(
        modules=len(files),
        mutants=len(mutants),
        killed=len(forks.killed),
        survivors=tuple(_survivor(mutant, mutant in forks.reached) for mutant in forks.alive),
        left_out=tuple(forks.left_out),
        whole=status != pytest.ExitCode.INTERRUPTED,
    )


def module_name(path: Path) -> str:
    """Of a file below the repository."""
    return ".".join(path.relative_to(ROOT).with_suffix("").parts)


def _survivor(mutant: Mutant, reached: bool) -> Survivor:
    text = mutant.path.read_text(encoding="utf-8").splitlines()[mutant.line - 1].strip()
    return Survivor(mutant.path.relative_to(ROOT).as_posix(), mutant.line, text, mutant.change, reached)


def run(name: str, sample: int, seed: int, output: Path) -> Judged:
    """A group by its name, its result kept as JSON."""
    group = GROUPS[name]
    result = judged(group, sampled(group, sample, seed))
    output.write_text(json.dumps(asdict(result), indent=1), encoding="utf-8")
    return result


def read(path: Path) -> Judged:
    """What ``run`` kept."""
    found = json.loads(path.read_text(encoding="utf-8"))
    survivors = tuple(Survivor(**survivor) for survivor in found.pop("survivors"))
    return Judged(**{**found, "survivors": survivors, "left_out": tuple(found["left_out"])})
