"""Result files that were damaged, edited and forged are refused or disagreed with, and bring no command down."""

from __future__ import annotations

import itertools
import json
import random
import shutil
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from tests.results.changed_files import changing
from tests.trust.corrupted.commands import REFUSED, Worker, claims, commands, differing, faults_of, worker
from tests.trust.corrupted.damage import DAMAGES, damaged
from tests.trust.corrupted.forgery import MALFORMED, change_figure, datasets, figures, words
from tests.trust.corrupted.originals import DECKS, write_originals
from tests.trust.counts import record_counts

DAMAGED, MALFORMED_FILES, FORGED = 450, 250, 300
"""files of each family in the full form: 1,000"""


@dataclass
class Found:
    """What a check counted, and what was wrong, in words."""

    counts: Counter[str] = field(default_factory=Counter)
    wrong: list[str] = field(default_factory=list)


class Check:
    """Originals, a worker, and what was found so far."""

    def __init__(self, folder: Path, runner: Worker, names: Iterable[str] = tuple(DECKS)) -> None:
        self.folder, self.worker, self.found = folder, runner, Found()
        self.originals = write_originals(folder, names)
        self.good = next(iter(self.originals.values()))
        self.told = {name: self._told(path) for name, path in self.originals.items()}

    def _told(self, path: Path) -> dict[str, str]:
        """What show and verify say of a file as it was written."""
        asked = commands(path, path, self.folder)
        return {name: self.worker.run(*asked[name]).out for name in ("show", "verify")}

    def fresh(self, name: str) -> Path:
        """A copy of an original to be spoilt."""
        path = self.folder / "spoilt" / f"{name}.h5"
        path.parent.mkdir(exist_ok=True)
        shutil.copy(self.originals[name], path)
        return path

    def refused_by_all(self, path: Path, what: str, names: tuple[str, ...] = ()) -> None:
        """Every command must refuse the file."""
        self.found.counts["files"] += 1
        for name, arguments in commands(path, self.good, self.folder / "out").items():
            if names and name not in names:
                continue
            ended = self.worker.run(*arguments)
            self.found.counts["commands"] += 1
            self.found.wrong += [f"{what}: {name}: {fault}" for fault in faults_of(path, ended)]
            if ended.status != REFUSED:
                self.found.wrong.append(f"{what}: {name} ends with {ended.status} instead of {REFUSED}")
        self.found.counts["refused"] += 1

    def judged(self, path: Path, original: str, what: str, names: tuple[str, ...] = ()) -> None:
        """No command may fail to end well; verify must not agree with other claims than those of the original."""
        self.found.counts["files"] += 1
        for name, arguments in commands(path, self.good, self.folder / "out").items():
            if names and name not in names:
                continue
            ended = self.worker.run(*arguments)
            self.found.counts["commands"] += 1
            self.found.wrong += [f"{what}: {name}: {fault}" for fault in faults_of(path, ended)]
            if name != "verify":
                continue
            if ended.status == REFUSED:
                self.found.counts["refused"] += 1
            elif not ended.out or not json.loads(ended.out)["agrees"]:
                self.found.counts["disagreed"] += 1
            else:
                self.found.counts["without effect"] += 1
                changed = differing(claims(self.told[original]["verify"]), claims(ended.out))
                self.found.wrong += [f"{what}: verify agrees with another claim: {place}" for place in changed[:3]]

    def malformed(self, path: Path, original: str, what: str) -> None:
        """Refused by every command, or told as the original is."""
        show = self.worker.run("show", path)
        if show.status == REFUSED:
            self.refused_by_all(path, what)
            return
        self.judged(path, original, what)

    def done(self) -> None:
        assert not self.found.wrong, "\n".join([f"{len(self.found.wrong)} faults", *self.found.wrong[:60]])


def spoil_by_damage(check: Check, number: int) -> None:
    generator = random.Random(1)
    for row, kind, original in zip(range(number), itertools.cycle(DAMAGES), itertools.cycle(check.originals)):
        path = check.fresh(original)
        path.write_bytes(damaged(path.read_bytes(), kind, generator))
        check.malformed(path, original, f"damage {row}, {kind}, {original}")


def spoil_by_form(check: Check, number: int) -> None:
    generator = random.Random(3)
    for row, kind, original in zip(range(number), itertools.cycle(MALFORMED), itertools.cycle(check.originals)):
        path = check.fresh(original)
        with changing(path) as file:
            name = generator.choice(datasets(file))
            MALFORMED[kind](file, name, generator)
        check.malformed(path, original, f"form {row}, {kind}, {name}, {original}")


def spoil_by_figures(check: Check, number: int) -> None:
    generator = random.Random(4)
    for row, original in zip(range(number), itertools.cycle(check.originals)):
        path = check.fresh(original)
        name = generator.choice(words(path) if row % 8 == 7 else figures(path))
        with changing(path) as file:
            change_figure(file, name, generator)
        check.judged(path, original, f"figure {row}, {name}, {original}")


def test_some_files(tmp_path: Path) -> None:
    """A few of each family, with the commands that cost little."""
    with worker(tmp_path) as runner:
        check = Check(tmp_path, runner, ["overhang"])
        spoil_by_damage(check, len(DAMAGES))
        _would_find_agreement_with_another_claim(check)
    check.done()
    assert check.found.counts["refused"] >= len(DAMAGES) - 1


def _would_find_agreement_with_another_claim(check: Check) -> None:
    """A check that knows of another weight than the file has holds it against verify, which agrees with it."""
    told = json.loads(check.told["overhang"]["verify"])
    told["model"]["total_weight"] *= 1.25
    kept, check.found, verified = check.found, Found(), check.told["overhang"]["verify"]
    check.told["overhang"]["verify"] = json.dumps(told)
    check.judged(check.fresh("overhang"), "overhang", "as written", ("verify",))
    found, check.found = check.found, kept
    check.told["overhang"]["verify"] = verified
    assert found.counts["without effect"] == 1
    assert [fault for fault in found.wrong if "verify agrees with another claim: .model.total_weight" in fault]


@pytest.mark.trust
def test_a_thousand_files(tmp_path: Path) -> None:
    with worker(tmp_path, "--drawing") as runner:
        check = Check(tmp_path, runner)
        spoil_by_damage(check, DAMAGED)
        spoil_by_form(check, MALFORMED_FILES)
        spoil_by_figures(check, FORGED)
    check.done()
    counts = check.found.counts
    record_counts(
        "corrupted-results",
        60,
        "A result file that was damaged after the run is refused or read as it was written, and `mbla verify` agrees "
        "with none whose figures were changed, unless the change leaves every claim as it was",
        {
            "spoilt files": counts["files"],
            "commands run on them": counts["commands"],
            "files refused by every command": counts["refused"],
            "files that verify disagrees with": counts["disagreed"],
            "files whose claims the change left as they were": counts["without effect"],
            "crashes, or other claims that verify agreed with": len(check.found.wrong),
        },
    )
