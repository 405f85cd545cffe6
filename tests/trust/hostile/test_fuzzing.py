"""Files changed at random are refused in clear words, or are models; nothing else happens."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings

from tests.trust.counts import record_counts
from tests.trust.hostile import subject
from tests.trust.hostile.at_random import at_random, by_hypothesis, files, give_in_batches
from tests.trust.hostile.finds import Finds

AT_RANDOM = int(os.environ.get("MBLA_FUZZING_AT_RANDOM", "100000"))
BY_HYPOTHESIS = int(os.environ.get("MBLA_FUZZING_BY_HYPOTHESIS", "5000"))
GUIDED = int(os.environ.get("MBLA_FUZZING_GUIDED", "100000"))
"""files that the full check gives"""
FOLDER = os.environ.get("MBLA_FUZZING_FOLDER")
"""where a run that was interrupted left its records, and where this one leaves its own"""


@settings(max_examples=40, suppress_health_check=list(HealthCheck), derandomize=True)
@given(file=files())
def test_a_changed_file_is_refused_in_clear_words_or_is_a_model(tmp_path_factory: Any, file: tuple[str, bytes]) -> None:
    folder = tmp_path_factory.mktemp("given")
    subject.prepare_folder(folder)
    assert subject.give(*file, folder) in ("DeckError", "accepted")


def test_a_program_that_breaks_is_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*arguments: object) -> None:
        raise KeyError("stone")

    monkeypatch.setattr(subject, "read_deck", broken)
    finds = give_in_batches(at_random, tmp_path, 40, 1)
    assert next(iter(finds.found.values())).startswith("KeyError")
    assert list((tmp_path / "finds").iterdir())


def test_a_run_goes_on_where_its_record_ends(tmp_path: Path) -> None:
    once = give_in_batches(at_random, tmp_path / "once", 20, 1)
    give_in_batches(at_random, tmp_path / "twice", 10, 1)
    again = give_in_batches(at_random, tmp_path / "twice", 20, 1)
    assert (again.runs, again.ended) == (once.runs, once.ended) == (20, once.ended)


@pytest.mark.trust
def test_many_changed_files_and_a_fuzzer_that_looks_at_coverage(tmp_path: Path) -> None:
    if GUIDED:
        pytest.importorskip("atheris", reason="the fuzzer that looks at coverage needs the extra fuzz")
    place = Path(FOLDER) if FOLDER else tmp_path
    random_finds = give_in_batches(at_random, place, AT_RANDOM, 1)
    drawn = give_in_batches(by_hypothesis, place, BY_HYPOTHESIS, 1)
    assert not random_finds.found | drawn.found
    guided = _guided(place) if GUIDED else Finds(place)
    assert not guided.found
    record_counts(
        "hostile-fuzzing",
        32,
        "Decks, sweep files and geometry files changed at random are refused in one line per fault or read as models: "
        "no crash, no internal error, none takes more than 5 seconds of processor time",
        {
            "files changed at random": random_finds.runs,
            "files drawn by hypothesis": drawn.runs,
            "files of a fuzzer that looks at coverage": guided.runs,
            "of all taken as models": sum(finds.accepted() for finds in (random_finds, drawn, guided)),
        },
    )


def _guided(place: Path) -> Finds:
    """Let the fuzzer run, on from where it was interrupted."""
    command = [sys.executable, "-m", "tests.trust.hostile.coverage_guided", str(place), str(GUIDED)]
    subprocess.run(command, cwd=Path(__file__).parents[3], check=True, capture_output=True)
    return Finds(**json.loads((place / "result.json").read_text(encoding="utf-8")))
