"""What the rules accept; what they refuse is in tests/invalid_decks.

What does not go with ``contact_model: convex`` is refused in one line each.

A key that is given and has no effect is said to have none; one that has an effect is not.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from mbla.deck import read_deck
from mbla.deck.section import EXACTLY_ONE, KINDS, RULES, Rule, Section
from mbla.deck.sections.analysis import APPLIES, AnalysisSection
from mbla.errors import DeckError, Finding
from tests.deck.decks import changed, write
from tests.line import BLOCK, line_of

WALL = (
    "wall: {group: block, material: stone, unit: [0.4, 0.2, 0.175], length: 2, courses: 6, "
    "openings: [{from: [0, 0], to: [2, 1.05]}]}"
)
BOX = "box: {group: block, material: stone, min: [0, 0, 0], max: [1, 1, 1]}"
LIVE = "[{acceleration: [1, 0, 0]}]"


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('{friction: "=mu"}', "{friction: 0}"),
        ('{friction: "=mu"}', "{friction_angle: 33, dilatancy: 33}"),
        ('{friction: "=mu"}', "{friction: 1, dilatancy: 45}"),
        ('{friction: "=mu"}', "{friction: 0.5, cohesion: 1000, tensile_strength: 2000}"),
        ('{friction: "=mu"}', "{friction: 0, tensile_strength: 5}"),
        (BOX, WALL),
        (LIVE, "[{gravity: [1, 0, 0]}]"),
        (LIVE, "[{acceleration: [0, 0, 1.e-300]}]"),
        (LIVE, "[{acceleration: [1, 0, 0], on: block}]"),
        (LIVE, "[{force: [1, 0, 0], on: {group: block, index: 0}}]"),
        (LIVE, LIVE + "\n    dead: []"),
        (LIVE, LIVE + "\n    dead: [{gravity: none}]"),
        ("{ground: {z: 0}}", "{blocks: block, fixed: [x, rz]}"),
        (
            "{ground: {z: 0}}",
            "{blocks: block, slide: [1, 0, 0], turn: {axis: [1, 0, 0], about: [0, 0, 0]}, together: true}",
        ),
        (f"live: {LIVE}", "settlement: {on: block, direction: [0, 0, -1]}"),
        (f"live: {LIVE}", "settlement: {on: [block], turn: {axis: [0, 1, 0], about: [0, 0, 0]}}"),
        (LIVE, LIVE + "\n    dead: [{gravity: [0, 0, 0]}]"),
        (LIVE, LIVE + "\n    dead: [{acceleration: [0, 0, -1]}]"),
        ("supports:\n  - {ground: {z: 0}}\n", ""),
        ("{ground: {z: 0}}", "{ground: {z: 0}, blocks: block, joint: dry}"),
        (LIVE, LIVE + "\nanalysis: {flow_rule: associative, friction_cone: polyhedral, solver: highs}"),
        (LIVE, LIVE + "\nanalysis: {flow_rule: livesley, solver: highs}"),
    ],
)
def test_accepted(tmp_path: Path, old: str, new: str) -> None:
    assert read_deck(write(tmp_path, changed(old, new))).content.mbla == 1


def test_box_of_a_group_that_several_items_make(tmp_path: Path) -> None:
    deck = read_deck(write(tmp_path, changed(f"  - {BOX}\n", f"  - {BOX}\n  - {BOX}\n")))
    assert len(deck.content.blocks) == 2


def test_exactly_one_names_keys_of_the_types() -> None:
    for section, keys in EXACTLY_ONE.items():
        assert issubclass(section, Section)
        assert set(keys) <= set(section.model_fields)


def test_long_lists_of_kinds_have_a_name() -> None:
    assert set(KINDS) == {section for section, keys in EXACTLY_ONE.items() if len(keys) > 8}


def test_every_rule_is_broken_by_a_faulty_deck(monkeypatch: pytest.MonkeyPatch) -> None:
    of_decks = {section: RULES[section] for section in RULES if section.__module__.startswith("mbla.deck.")}
    broken: set[Rule] = set()

    def recorded(check: Rule) -> Rule:
        def run(section: Any) -> Iterator[Finding]:
            for finding in check(section):
                broken.add(check)
                yield finding

        return run

    for section, checks in of_decks.items():
        monkeypatch.setitem(RULES, section, [recorded(check) for check in checks])
    for path in (Path(__file__).parents[1] / "invalid_decks").glob("deck_*.yaml"):
        with pytest.raises(DeckError):
            read_deck(path)
    assert {check for checks in of_decks.values() for check in checks} == broken


CONVEX = BLOCK.replace("analysis: {flow_rule: associative}", "analysis: {contact_model: convex}")


@pytest.mark.parametrize(
    "override",
    [
        "analysis.flow_rule=associative",
        "analysis.scheme=proximal",
        "analysis.solver=clarabel",
        "contacts.points.per_edge=2",
    ],
)
def test_what_goes_with_it(override: str) -> None:
    assert line_of(CONVEX, override).deck.analysis.contact_model == "convex"


WITHOUT = BLOCK.replace("analysis: {flow_rule: associative}", "analysis: {}")


def idle(*overrides: str) -> list[str]:
    notices = line_of(WITHOUT, *overrides).deck.notices
    return [notice.message for notice in notices if notice.identifier == "key-idle"]


@pytest.mark.parametrize(
    ("key", "idle_with", "used_with"),
    [
        ("analysis.sides=6", "flow_rule=associative", "friction_cone=polyhedral"),
        ("analysis.scheme=interior", "flow_rule=associative", "flow_rule=non_associative"),
        ("analysis.proximal.max_programs=9", "scheme=interior", "scheme=proximal"),
        ("analysis.interior.tries=2", "contact_model=convex", "scheme=interior"),
        ("analysis.lowest.seed=2", "scheme=auto", "scheme=lowest"),
        ("analysis.published.slope=0.01", "scheme=auto", "scheme=published"),
        ("analysis.gap=1e-5", "contact_model=convex", "contact_model=concave"),
        ("analysis.residual=1e-5", "flow_rule=associative", "flow_rule=dilatancy"),
        ("analysis.residual=1e-5", "scheme=published", "scheme=interior"),
        ("analysis.peak=false", "flow_rule=dilatancy", "flow_rule=non_associative"),
        ("analysis.range=false", "flow_rule=associative", "flow_rule=livesley"),
        ("analysis.reductions=false", "contact_model=convex", "contact_model=concave"),
        ("joints.dry.dilatancy=5", "flow_rule=non_associative", "flow_rule=dilatancy"),
    ],
)
def test_with_what_a_key_has_an_effect(key: str, idle_with: str, used_with: str) -> None:
    linear = ["analysis.flow_rule=associative"] if "polyhedral" in used_with else []
    (message,) = idle(key, f"analysis.{idle_with}")
    assert "has no effect: it applies to" in message
    assert idle(key, f"analysis.{used_with}", *linear) == []


def test_keys_that_are_not_given_are_not_mentioned() -> None:
    assert idle() == idle("analysis.flow_rule=associative") == []


def test_every_entry_is_a_key() -> None:
    assert set(APPLIES) <= set(AnalysisSection.model_fields)
