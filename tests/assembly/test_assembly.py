"""What the solver sees under the load cases of a deck: worked out once, another one where the load case makes it so."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from mbla.assembly import Assembly, build_assembly
from mbla.deck import read_deck
from mbla.model import build_model
from mbla.model.settlement import with_reference

DECK = """
mbla: 1
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.6}}
blocks:
  - box: {group: left, material: stone, min: [0, 0, -1], max: [1, 1, 0]}
  - box: {group: right, material: stone, min: [2, 0, -1], max: [3, 1, 0]}
  - box: {group: beam, material: stone, min: [0, 0, 0], max: [3, 1, 0.5]}
contacts: {joint: dry}
supports: [{blocks: [left, right]}]
ties: [{name: rod, through: [[0.5, 0.5, -0.5], [0.5, 0.5, 0.25]], on: [left, beam], capacity: 1000, prestress: 100}]
load_cases:
  push: {live: [{acceleration: [1, 0, 0]}]}
  pull: {live: [{acceleration: [-1, 0, 0]}]}
  sink: {settlement: {on: right, direction: [0, 0, -1]}}
  bearing: {objective: {force: {on: beam, from: right, direction: [0, 0, 1]}}}
"""


def assembly(folder: Path) -> Assembly:
    path = folder / "deck.yaml"
    path.write_text(DECK, encoding="utf-8")
    deck = read_deck(path)
    return build_assembly(deck, build_model(deck))


def test_load_cases_share_what_the_solver_sees_where_it_is_the_same(tmp_path: Path) -> None:
    own = assembly(tmp_path)
    push, pull, sink, least, greatest = own.model.load_cases
    assert own.of(push) is own.of(pull)
    assert own.of(sink) is own.of(with_reference(sink, 3.0))
    assert len({id(own.of(case)) for case in (push, sink, least, greatest)}) == 4
    assert own.glued(push) is own.glued(least) is own.glued()
    solved = own.with_load_cases((push, with_reference(sink, 3.0)))
    assert [case.name for case in solved.model.load_cases] == ["push", "sink"]
    assert solved.of(sink) is own.of(sink)
    assert replace(own, model=solved.model).of(push) is not own.of(push)


def test_a_support_that_gives_way_may_move(tmp_path: Path) -> None:
    own = assembly(tmp_path)
    push, _, sink, *_ = own.model.load_cases
    assert own.of(push).model.fixed.tolist() == [True, True, False]
    assert own.of(sink).model.fixed.tolist() == [True, False, False]
    assert own.model.fixed.tolist() == [True, True, False]


def test_a_load_cell_is_the_last_body_and_slides_along_what_it_measures(tmp_path: Path) -> None:
    own = assembly(tmp_path)
    *_, least, greatest = own.model.load_cases
    for case, sense in ((least, 1.0), (greatest, -1.0)):
        bodies = own.of(case)
        assert bodies.load_cell is not None
        assert bodies.load_cell.direction.tolist() == [0, 0, sense, 0, 0, 0]
        assert len(bodies.model.blocks) == len(own.model.blocks) + 1
        assert bodies.model.guides.blocks.tolist() == [3]
        assert bodies.contacts.cut is not None
        assert np.count_nonzero(bodies.contacts.cut) == 1
        assert bodies.load_case(with_reference(case, 5.0)).dead_load[3, 2] == -5.0 * sense


def test_prestress_of_ties_is_a_dead_load_on_bodies(tmp_path: Path) -> None:
    own = assembly(tmp_path)
    push = own.model.load_cases[0]
    bodies = own.of(push)
    assert bodies.contacts.ties is not None
    assert len(bodies.contacts) == len(own.contacts) + 1
    assert bodies.tie_prestress_load is not None
    assert bodies.load_case(push).dead_load[2, 2] - push.dead_load[2, 2] == -100.0
    assert own.glued(push).tie_prestress_load is None
