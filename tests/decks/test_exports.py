"""What the comments of the two exported structures say about contacts.tolerance."""

from __future__ import annotations

import json
from typing import Any

import pytest

from mbla.cli import main
from tests.decks.folder import DECKS


def check(
    deck: str, tolerance: float, capsys: pytest.CaptureFixture[str]
) -> tuple[int, dict[str, Any], dict[str, str]]:
    """Exit status and JSON of ``mbla check``, and its notices by their identifiers."""
    path = DECKS / "tutorials" / f"{deck}.yaml"
    status = main(["check", str(path), "--json", "--set", f"contacts.tolerance={tolerance}"])
    record: dict[str, Any] = json.loads(capsys.readouterr().out)
    return status, record, {notice["identifier"]: notice["message"] for notice in record.get("notices", [])}


@pytest.mark.parametrize("tolerance", [1.2e-3, 2e-3, 5e-3, 1e-2])
def test_the_vault_has_the_same_contacts_over_a_decade(tolerance: float, capsys: pytest.CaptureFixture[str]) -> None:
    status, record, notices = check("crossvault", tolerance, capsys)
    model = record["model"]
    assert (status, model["blocks"], model["free_blocks"], model["interfaces"]) == (0, 184, 180, 488)
    assert not {"near-misses", "isolated-blocks"} & notices.keys()
    assert tolerance != 2e-3 or notices["slivers-dropped"].startswith("15 common surfaces")


@pytest.mark.parametrize(("tolerance", "overlapping"), [(1e-4, 6), (1e-3, 1)])
def test_the_vault_is_refused_where_its_blocks_overlap(
    tolerance: float, overlapping: int, capsys: pytest.CaptureFixture[str]
) -> None:
    status, record, _ = check("crossvault", tolerance, capsys)
    assert status == 3
    assert sum("overlap by" in message for message in record["errors"]) == overlapping


@pytest.mark.parametrize(("tolerance", "near_misses"), [(1e-4, 0), (1e-3, 0), (1e-2, 31)])
def test_the_wall_touches_in_its_bed_joints_only(
    tolerance: float, near_misses: int, capsys: pytest.CaptureFixture[str]
) -> None:
    status, record, notices = check("obj_wall", tolerance, capsys)
    assert (status, record["model"]["blocks"], record["model"]["interfaces"]) == (0, 38, 65)
    assert "slivers-dropped" not in notices
    assert notices.get("near-misses", "0").split()[0] == str(near_misses)
