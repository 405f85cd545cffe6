"""Files changed at random are refused in clear words, or are models; nothing else happens."""

from __future__ import annotations

import importlib.util
import json
import os
import subprocess
import sys
from pathlib import Path
from random import Random
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.trust.counts import record_counts
from tests.trust.hostile import subject
from tests.trust.hostile.finds import Finds
from tests.trust.hostile.mutations import changed
from tests.trust.hostile.samples import seeds

SEEDS = seeds()
AT_RANDOM = int(os.environ.get("MBLA_FUZZING_AT_RANDOM", "100000"))
GUIDED = int(os.environ.get("MBLA_FUZZING_GUIDED", "100000"))
"""files that the full check gives"""


def give_at_random(finds: Finds, folder: Path, runs: int, seed: int) -> None:
    """Files changed up to five times, each from another seed."""
    for number in range(runs):
        rng = Random(seed * 10**9 + number)
        kind, content = rng.choice(SEEDS)
        for _ in range(rng.choice((1, 1, 2, 3, 5))):
            content = changed(kind, content, rng.choice)
        finds.give(kind, content, folder)


@settings(max_examples=40, deadline=None, suppress_health_check=list(HealthCheck), derandomize=True)
@given(data=st.data())
def test_a_changed_file_is_refused_in_clear_words_or_is_a_model(tmp_path_factory: Any, data: st.DataObject) -> None:
    folder = tmp_path_factory.mktemp("given")
    subject.prepare_folder(folder)
    kind, content = data.draw(st.sampled_from(SEEDS))
    for _ in range(data.draw(st.integers(1, 4))):
        content = changed(kind, content, lambda options: data.draw(st.sampled_from(options)))
    assert subject.give(kind, content, folder) in ("DeckError", "accepted")


def test_a_program_that_breaks_is_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*arguments: object) -> None:
        raise KeyError("stone")

    monkeypatch.setattr(subject, "read_deck", broken)
    subject.prepare_folder(tmp_path)
    finds = Finds(tmp_path / "finds")
    give_at_random(finds, tmp_path, 40, 1)
    assert next(iter(finds.found.values())).startswith("KeyError")
    assert list((tmp_path / "finds").iterdir())


@pytest.mark.trust
def test_many_changed_files_and_a_fuzzer_that_looks_at_coverage(tmp_path: Path) -> None:
    subject.prepare_folder(tmp_path)
    finds = Finds(tmp_path / "finds")
    give_at_random(finds, tmp_path, AT_RANDOM, 1)
    assert not finds.found
    guided = 0
    if importlib.util.find_spec("atheris") and GUIDED:
        command = [sys.executable, "-m", "tests.trust.hostile.coverage_guided", str(tmp_path), str(GUIDED)]
        subprocess.run(command, cwd=Path(__file__).parents[3], check=True, capture_output=True)
        record = json.loads((tmp_path / "result.json").read_text(encoding="utf-8"))
        assert not record["found"]
        guided = record["runs"]
    record_counts(
        "hostile-fuzzing",
        32,
        "Decks, sweep files and geometry files changed at random are refused in one line per fault or read as models: "
        "no crash, no internal error, none takes more than 5 seconds of processor time",
        {
            "files changed at random": finds.runs,
            "files of a fuzzer that looks at coverage": guided,
            "of the first taken as models": finds.accepted(),
        },
    )
