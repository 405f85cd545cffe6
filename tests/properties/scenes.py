"""Scenes of metamorphic checks: a deck as model and sections, and its load cases solved as ``mbla run`` solves them."""

from __future__ import annotations

import io
import json
import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from mbla.assembly import Assembly, build_assembly
from mbla.contacts import Contacts
from mbla.deck import Deck, read_deck
from mbla.model import Model, build_model
from mbla.questions.angle import Angle
from mbla.questions.reaction import Reaction
from mbla.results.provenance import with_loads_found
from mbla.results.results import CaseResult
from mbla.results.status_file import StatusFile
from mbla.run import solve_case
from mbla.solution.settings import solver_settings
from mbla.solution.solution import Status
from tests.properties.random_decks import random_deck

MOST_CASES = 2
"""load cases of a deck that are solved, the first and the last: positions of a travelling load are many and alike"""


@dataclass(frozen=True)
class Scene:
    """A model with the sections of its deck that say how contacts are found and how it is solved.

    change : what is made of the contacts after they were found; None for nothing
    """

    name: str
    deck: Deck
    model: Model
    change: Callable[[Contacts], Contacts] | None = None

    def assembly(self) -> Assembly:
        """Contacts, and the model with the blocks held that glue holds."""
        found = build_assembly(self.deck, self.model)
        return found if self.change is None else replace(found, contacts=self.change(found.contacts))

    @property
    def section_text(self) -> str:
        """The section `contacts` as JSON."""
        return json.dumps(self.deck.contacts.model_dump(mode="json", by_alias=True, exclude_none=True))


@dataclass(frozen=True)
class Solved:
    """What came out of a scene."""

    model: Model
    contacts: Contacts
    cases: tuple[CaseResult, ...]

    @property
    def conditions(self) -> bool:
        """Interfaces have conditions of their own: torsion, or crushing."""
        return any(case.solution.conditions_on_interfaces for case in self.cases)


def scene_of(path: Path, *overrides: str) -> Scene:
    """A deck on the disk under associative flow with round friction, to the last digits: its first movement only."""
    deck = read_deck(path, overrides)
    model = build_model(deck)
    cases = tuple(replace(case, pushover=None) for case in model.load_cases)
    if len(cases) > MOST_CASES:
        cases = cases[0], cases[-1]
    model = replace(model, load_cases=cases)
    scene = Scene(f"{path.parent.name}/{path.stem}", deck, model)
    keep = {"contact_model": deck.analysis.contact_model}
    return with_analysis(scene, whole=True, flow_rule="associative", accuracy="reference", standing=False, **keep)


def random_scene(seed: int) -> Scene:
    """A random deck, by the seed of :mod:`tests.properties.random_decks`."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "deck.yaml"
        path.write_text(json.dumps(random_deck(seed)), encoding="utf-8")
        return replace(scene_of(path), name=f"random/{seed}")


def with_analysis(scene: Scene, whole: bool = False, **changes: Any) -> Scene:
    """The same solved otherwise; ``whole``: nothing of the deck's own analysis is left."""
    content = scene.deck.content
    analysis = type(content.analysis)() if whole else content.analysis
    analysis = analysis.model_copy(update=changes)
    return replace(scene, deck=replace(scene.deck, content=content.model_copy(update={"analysis": analysis})))


def with_section(scene: Scene, **changes: Any) -> Scene:
    """The same with other contacts."""
    content = scene.deck.content
    contacts = content.contacts.model_copy(update=changes)
    return replace(scene, deck=replace(scene.deck, content=content.model_copy(update={"contacts": contacts})))


def solve_scene(scene: Scene) -> Solved:
    """Every load case, assembled, solved and verified."""
    deck = scene.deck
    assembly = scene.assembly()
    settings, status_file = solver_settings(deck.analysis), StatusFile(io.StringIO(), "metamorphic")
    cases = tuple(solve_case(deck, assembly, case, settings, status_file, None) for case in assembly.model.load_cases)
    return Solved(with_loads_found(assembly, cases).model, assembly.contacts, cases)


def value_of(case: CaseResult) -> float:
    """What is compared: the load factor; tangent of the angle of a tilting table; reaction of a support that gives way
    over its unit, negative, which the load factor adds to. inf where it has no bound, -inf where nothing stands.
    """
    if case.status is Status.UNBOUNDED:
        return math.inf
    if case.status is Status.NO_EQUILIBRIUM:
        return -math.inf
    mechanics = case.solution.mechanics
    if case.status is not Status.SOLVED or mechanics is None:
        return math.nan
    return _shown(case, mechanics.load_factor)


def _shown(case: CaseResult, factor: float) -> float:
    load_case = case.load_case
    match load_case.question:
        case Reaction(settlement):
            return -settlement.reaction(factor) / settlement.unit
        case Angle(tilt):
            return float(np.tan(np.deg2rad(tilt.angle)))
    return factor


def bounds_of(case: CaseResult) -> tuple[float, float]:
    """Proved bounds of the associative figure as ``value_of`` has it; of a tilting table its own.

    The angle is known as well as the load factor of 1 that its last program has: the bounds of that lie around 1.
    """
    if case.load_case.question.by_steps:
        return value_of(case) * case.checks.static_bound, value_of(case) * case.checks.kinematic_bound
    lower, upper = (_shown(case, bound) for bound in (case.checks.static_bound, case.checks.kinematic_bound))
    return lower, upper
