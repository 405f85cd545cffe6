"""The same random assembly by the program and by others, in memory."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from mbla.deck import read_deck
from mbla.model import build_model
from mbla.results.results import CaseResult
from tests.properties.random_items import Tree
from tests.properties.scenes import Scene, Solved, solve_scene, value_of, with_analysis
from tests.trust.certificates.assemblies import assembly, at_points
from tests.trust.certificates.rational import exact_case
from tests.trust.second_opinion.friction_polyhedra import Bracket, bracket_of


@dataclass(frozen=True)
class BesidePolyhedra:
    """Load factor by the program and the bracket of both linear programs.

    value : -inf without equilibrium, inf locked by friction, nan left open
    """

    name: str
    status: str
    value: float
    bracket: Bracket


@dataclass(frozen=True)
class BesideConvex:
    """Load factors of both contact models, as ``value``.

    twists, crushes : whether an interface of the convex model moves by torsion, or by crushing, in its mechanism
    """

    name: str
    concave: float
    convex: float
    twists: bool
    crushes: bool


def beside_polyhedra(seed: int) -> BesidePolyhedra:
    """An assembly by the program and by HiGHS, with joints that crush at points alone."""
    scene = _scene(at_points(assembly(seed)))
    solved = solve_scene(scene)
    case = solved.cases[0]
    bracket = bracket_of(exact_case(solved.model, solved.contacts, case.load_case))
    return BesidePolyhedra(scene.name, str(case.status), value_of(case), bracket)


def beside_convex(seed: int) -> BesideConvex:
    """An assembly by both contact models."""
    scene = _scene(assembly(seed))
    concave = solve_scene(scene)
    convex = solve_scene(with_analysis(scene, contact_model="convex"))
    twists, crushes = _interface_motions(convex)
    return BesideConvex(scene.name, value_of(concave.cases[0]), value_of(convex.cases[0]), twists, crushes)


def _scene(deck_tree: Tree) -> Scene:
    with TemporaryDirectory() as folder:
        path = Path(folder) / "deck.yaml"
        path.write_text(json.dumps(deck_tree), encoding="utf-8")
        deck = read_deck(path)
        return Scene(str(deck_tree["title"]), deck, build_model(deck))


MOVES = 1e-6
"""motion of an interface, over the fastest contact, that is more than rounding"""


def _interface_motions(solved: Solved) -> tuple[bool, bool]:
    case: CaseResult = solved.cases[0]
    mechanics = case.solution.mechanics
    if mechanics is None or mechanics.interface_motions is None:
        return False, False
    lengths = np.sqrt(solved.contacts.areas)[:, None, None]
    motions = np.abs(mechanics.interface_motions) * np.concatenate(
        [np.ones((len(lengths), 1, 3)), lengths.repeat(3, axis=2)], axis=2
    )
    speed = float(np.linalg.norm(mechanics.contact_velocities, axis=1).max(initial=0.0))
    largest = motions.max(axis=(0, 2), initial=0.0) > MOVES * speed
    return bool(largest[0]), bool(largest[1])
