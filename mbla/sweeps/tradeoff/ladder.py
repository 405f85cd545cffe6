"""The ladder of a deck: presets, tolerances, solvers, polyhedra, schemes, other models; or what a user names."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from mbla.deck import Deck
from mbla.errors import DeckError, UsageError
from mbla.sweeps.measure.setting import Setting, given_knobs, read_setting
from mbla.sweeps.tradeoff.mechanics import other_model
from mbla.sweeps.tradeoff.rung import REFERENCE, Rung

PRESETS = ("standard", "reference", "draft")
"""the reference early, so that a time limit that ends the ladder leaves something to compare"""
TOLERANCES = ("1e-4", "1e-6", "1e-8", "1e-10")
SOLVERS = ("mbla", "clarabel", "highs")
SIDES = (4, 8, 16, 32)
SCHEMES = ("proximal", "interior", "path", "published")
POINTS = (2, 3)
PLANAR = "friction has two directions in a planar structure: any polyhedron is exact"


def usual_ladder(deck: Deck, fixed: Sequence[str]) -> list[Rung]:
    """Every rung that mbla knows of, those that do not apply with the reason."""
    rungs = [_preset(deck, fixed, word) for word in PRESETS]
    rungs.append(Rung("the deck's own settings"))
    rungs += [Rung(f"tolerance: {value}", _of(f"analysis.tolerance={value}")) for value in TOLERANCES]
    rungs += [Rung(f"solver: {name}", _of(f"analysis.solver={name}")) for name in SOLVERS]
    rungs += [_polyhedron(sides) for sides in SIDES]
    rungs += [_scheme(deck, name) for name in SCHEMES]
    rungs += [_points(deck, number) for number in POINTS]
    rungs.append(Rung("contact_model: convex", _of("analysis.contact_model=convex")))
    rungs.append(Rung("flow_rule: associative", _of("analysis.flow_rule=associative")))
    return rungs


def asked_ladder(deck: Deck, fixed: Sequence[str], asked: Sequence[Rung]) -> list[Rung]:
    """The reference and the rungs that the user names."""
    return [_preset(deck, fixed, "reference"), *(rung for rung in asked if rung.name != REFERENCE)]


def fitted(path: Path, fixed: Sequence[str], deck: Deck, rungs: Sequence[Rung]) -> list[Rung]:
    """The rungs with what is wrong with them on this deck: refused by it, the same as an earlier one, another model.

    Raises UsageError where two rungs have one name.
    """
    ready: list[Rung] = []
    seen: dict[str, str] = {}
    for rung in rungs:
        if rung.name in [other.name for other in ready]:
            raise UsageError("tradeoff-option", f"{rung.name}: two settings of that name")
        if rung.unfit:
            ready.append(rung)
            continue
        try:
            content = read_setting(path, fixed, rung.setting).content
        except DeckError as error:
            ready.append(replace(rung, unfit="; ".join(fault.message for fault in error.faults)))
            continue
        same = seen.setdefault(content.model_dump_json(exclude={"output", "expected"}), rung.name)
        unfit = "" if same == rung.name else f"the same as {same}"
        ready.append(replace(rung, unfit=unfit, model=other_model(deck.content, content)))
    return ready


def _of(*overrides: str) -> Setting:
    return Setting(overrides)


def _preset(deck: Deck, fixed: Sequence[str], word: str) -> Rung:
    """One word, free of the knobs that the deck sets by itself; the reference with the true friction cone."""
    overrides = [f"analysis.accuracy={word}"]
    if word == "reference" and deck.analysis.friction_cone == "polyhedral":
        overrides.append("analysis.friction_cone=circular")
        if deck.analysis.solver == "highs":
            overrides.append("analysis.solver=auto")
    return Rung(f"accuracy: {word}", Setting(tuple(overrides), given_knobs(deck, fixed)))


def _polyhedron(sides: int) -> Rung:
    setting = _of("analysis.friction_cone=polyhedral", f"analysis.sides={sides}")
    return Rung(f"polyhedron: {sides} sides", setting, spatial=PLANAR)


def _scheme(deck: Deck, name: str) -> Rung:
    rule = deck.analysis.flow_rule
    unfit = "" if rule == "non_associative" else f"a scheme of flow_rule: non_associative ({rule} here)"
    return Rung(f"scheme: {name}", _of(f"analysis.scheme={name}"), unfit)


def _points(deck: Deck, number: int) -> Rung:
    spacing = deck.contacts.points.spacing
    unfit = "" if spacing is None else "the deck gives the spacing of contact points"
    return Rung(f"points per edge: {number}", _of(f"contacts.points.per_edge={number}"), unfit)
