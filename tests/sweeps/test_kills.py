"""Sweeps whose processes are killed at any moment end in the table of one that ran undisturbed."""

from __future__ import annotations

from pathlib import Path
from random import Random

import pytest

from tests.sweeps.killed_sweeps import (
    Scene,
    finish,
    keys_in_journals,
    scene,
    table_of,
    with_kills,
    written,
)

pytestmark = pytest.mark.long


def check_like_clean(killed: Scene, clean: Scene, reported: set[str]) -> None:
    """The same table, no row lost that was reported, and no point solved again whose row was there."""
    assert reported <= set(keys_in_journals(killed.folder))
    assert finish(killed) == finish(clean) == "exit 8"
    keys = keys_in_journals(killed.folder)
    assert sorted(keys) == sorted(task.key for task in killed.prepared.tasks)
    assert table_of(killed.folder) == table_of(clean.folder)
    assert not [path for path in killed.folder.iterdir() if path.name.startswith(".")]


def test_client_and_process_killed_a_few_times(tmp_path: Path) -> None:
    path = written(tmp_path, 12)
    killed, clean = scene(path, tmp_path / "killed"), scene(path, tmp_path / "clean")
    kills, reported = with_kills(killed, 2, Random(1), 0.1, 0.5)
    assert kills == 2
    check_like_clean(killed, clean, reported)
