from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from mbla.deck import read_deck
from mbla.errors import UsageError
from mbla.model import build_model
from mbla.sweeps.design.directions import horizontal
from mbla.sweeps.interaction.question import two_loads_question
from mbla.sweeps.plan import override_texts
from tests.sweeps.interaction.hand_made import live_load, question


def test_both_act_with_cosine_and_sine(tmp_path: Path) -> None:
    asked = question(tmp_path, loads=("named", "top"), directions=7, start=0.0, end=360.0)
    own = [live_load(tmp_path, (), name)[0] for name in ("named", "top")]
    for angle, settings in zip(asked.angles, asked.settings, strict=True):
        load, dead = live_load(tmp_path, override_texts(settings), asked.case)
        cosine, sine = horizontal(angle, 1.0)
        assert load == pytest.approx(cosine * own[0] + sine * own[1], abs=1e-9)
        assert dead == pytest.approx(live_load(tmp_path, (), "top")[1])


def test_a_dead_load_of_their_own_goes_along(tmp_path: Path) -> None:
    overrides = ["load_cases.push.dead=[{gravity: [0, 0, -5]}]"]
    asked = question(tmp_path, overrides, loads=("push", "weighed"), directions=2)
    _, dead = live_load(tmp_path, [*overrides, *override_texts(asked.settings[0])], asked.case)
    assert dead == pytest.approx([0, 0, -5 * 2000 * 2, 0, 0, 0])


def test_a_table_named_by_an_included_file_is_found(tmp_path: Path) -> None:
    """A setting is looked for from the main deck, whatever file named the table first."""
    (tmp_path / "below").mkdir()
    (tmp_path / "below" / "forces.csv").write_text("group,index,fx,fy,fz\nblock,0,0,7,0\n", encoding="utf-8")
    case = "load_cases: {rows: {live: [{table: forces.csv}]}}\n"
    (tmp_path / "below" / "rows.yaml").write_text(case, encoding="utf-8")
    question(tmp_path, loads=("push", "top"))
    text = (tmp_path / "block.yaml").read_text(encoding="utf-8")
    path = tmp_path / "main.yaml"
    path.write_text(text + "include: [below/rows.yaml]\n", encoding="utf-8")
    deck = read_deck(path)
    asked = two_loads_question(deck, build_model(deck), ("rows", "push"), 0.0, 90.0, 3)
    model = build_model(read_deck(path, override_texts(asked.settings[0])))
    (found,) = [one for one in model.load_cases if one.name == asked.case]
    assert found.live_load[0] == pytest.approx([0, 7, 0, 0, 0, 0])


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        ({"loads": ("push", "push")}, "name two different load cases"),
        ({"loads": ("push", "pull")}, "no load case pull"),
        ({"loads": ("push", "tilted")}, "load case tilted: its live load tilts"),
        ({"loads": ("push", "weighed")}, "push and weighed have different dead loads"),
        ({"loads": ("push", "top"), "start": 90.0, "end": 90.0}, "the end must lie above"),
        ({"loads": ("push", "top"), "end": 361.0}, "by 360 degrees at most"),
        ({"loads": ("push", "top"), "directions": 1}, "--directions 1: 2 to 3600"),
    ],
)
def test_refusals(tmp_path: Path, asked: dict[str, Any], words: str) -> None:
    with pytest.raises(UsageError, match=words):
        question(tmp_path, **asked)
