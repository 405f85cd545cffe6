"""Random decks that combine what a deck can say: items, joints, supports, loads, analysis."""

from __future__ import annotations

from random import Random
from typing import Any

from tests.properties.random_items import KINDS, LIKELY, Piece, Tree

APART = 6.0
"""distance of the pieces along x, more than any of them takes"""
LAWS: dict[str, Tree] = {
    "dry": {"friction": 0.6},
    "slippery": {"friction_angle": 12},
    "mortar": {"friction": 0.7, "cohesion": 2.0e4, "tensile_strength": 8.0e3},
    "weak": {"friction": 0.6, "compressive_strength": 4.0e5},
    "rough": {"friction": 0.6, "dilatancy": 10},
}


def random_deck(seed: int) -> Tree:
    """A deck; the same for the same seed."""
    rng = Random(seed)
    pieces = []
    for number in range(rng.choice([1, 1, 1, 2])):
        kind = rng.choices(list(KINDS), LIKELY)[0]
        pieces.append(_placed(KINDS[kind](rng, f"{kind}{number}"), number, rng))
    deck: Tree = {
        "mbla": 1,
        "title": f"random deck {seed}",
        "materials": {"stone": {"density": 2000}, "brick": {"unit_weight": 15000}},
        "joints": LAWS,
        "blocks": [item for piece in pieces for item in piece.items],
        "contacts": _contacts(rng, pieces),
        "supports": _supports(rng, pieces),
        "load_cases": _load_cases(rng, pieces),
        "analysis": _analysis(rng),
        "output": {"vtu": rng.random() < 0.5, "frames": 3},
    }
    if deck["analysis"].get("contact_model") == "convex":
        deck["contacts"].pop("points", None)
    for item in deck["blocks"]:
        next(iter(item.values()))["material"] = rng.choice(["stone", "brick"])
    if rng.random() < 0.2:
        deck["masses"] = [{"mass": 300, "on": _selector(rng, rng.choice(pieces))}]
    return deck


def _placed(piece: Piece, number: int, rng: Random) -> Piece:
    """Moved aside; some of them repeated, away from all others along y."""
    steps: list[Tree] = [{"translate": [APART * number, 0, 0]}] if number else []
    if rng.random() < 0.15:
        steps.append({"mirror": {"normal": [0, 1, 0], "point": [0, 0.3, 0]}})
    if rng.random() < 0.15:
        steps.append({"rotate": {"axis": [0, 0, 1], "angle": 25, "about": [APART * number, 0, 0]}})
    repeated = rng.random() < 0.15
    items = []
    for item in piece.items:
        kind, body = next(iter(item.items()))
        own = body.get("transform", [])
        body = body | {"transform": [*(own if isinstance(own, list) else [own]), *steps]}
        if repeated:
            body["repeat"] = {"count": 2, "translate": [0, 4.0, 0]}
        items.append({kind: body})
    labels = [*piece.labels, "copy"] if repeated else piece.labels
    return Piece(items, piece.grounded, piece.groups, labels, piece.held)


def _selector(rng: Random, piece: Piece) -> Any:
    group = rng.choice(piece.groups)
    if piece.labels and rng.random() < 0.4:
        return {"group": group, rng.choice(piece.labels): rng.choice([0, -1, [0, -1]])}
    return {"group": group, "index": 0} if rng.random() < 0.2 else group


def _one_block(rng: Random, piece: Piece) -> Tree:
    return {"group": rng.choice(piece.groups), "index": 0}


def _contacts(rng: Random, pieces: list[Piece]) -> Tree:
    contacts: Tree = {"joint": rng.choice(list(LAWS)), "overrides": []}
    laws = [*LAWS, "frictionless", "glued", "open"]
    for _ in range(rng.choice([0, 0, 1, 2])):
        group = rng.choice(rng.choice(pieces).groups)
        fits: Tree = rng.choice(
            [
                {"between": [group, group]},
                {"between": [group, "ground"]},
                {"between": [{"group": group, "index": 0}, group]},
                {"orientation": "bed"},
                {"orientation": "head"},
                {"orientation": {"normal": [1, 0, 1], "within": 50}},
                {"box": [[-1, -1, 0.1], [1, 1, 5]]},
            ]
        )
        contacts["overrides"].append({"joint": rng.choice(laws)} | fits)
    points = rng.choice([{}, {}, {}, {"inset": 0.1}, {"per_edge": 2}, {"spacing": 0.3}, {"rounding": 0.01}])
    if points:
        contacts["points"] = points
    return contacts


def _supports(rng: Random, pieces: list[Piece]) -> list[Tree]:
    supports: list[Tree] = []
    if any(piece.grounded for piece in pieces):
        supports.append({"ground": {"z": 0}} if rng.random() < 0.7 else {"ground": {"z": 0}, "joint": "dry"})
    if rng.random() < 0.15:
        block = _one_block(rng, rng.choice(pieces))
        kind: Tree = rng.choice(
            [
                {},
                {"fixed": ["x", "ry"]},
                {"fixed": ["y", "rx", "rz"]},
                {"slide": [1, 0, 0]},
                {"turn": {"axis": [0, 1, 0], "about": [0, 0, 0]}},
                {"fixed": ["rx", "ry", "rz"], "together": True},
            ]
        )
        supports.append({"blocks": block} | kind)
    return supports


def _live(rng: Random, piece: Piece) -> Tree:
    sign = rng.choice([-1, 1])
    load: Tree = rng.choice(
        [
            {"acceleration": [sign, 0, 0]},
            {"acceleration": [sign * 0.6, 0.8, 0.1], "on": _selector(rng, piece)},
            {"acceleration": [0, sign, 0], "pattern": {}},
            {"force": [sign * 1000.0, 300.0, 0], "on": _one_block(rng, piece)},
            {"moment": [200.0, sign * 1000.0, 0], "on": _one_block(rng, piece)},
            {"pressure": {"value": 1000, "normal": [sign, 0, 0]}},
            {"pressure": {"value": 500, "normal": [0, 0, 1], "within": 60}, "on": _selector(rng, piece)},
            {"pressure": {"level": 1.0, "per_depth": 10000, "normal": [0, sign, 0], "within": 45}},
        ]
    )
    return load if rng.random() < 0.7 else load | {"factor": 0.5}


def _load_cases(rng: Random, pieces: list[Piece]) -> Tree:
    cases: Tree = {}
    for number in range(rng.choice([1, 1, 2])):
        piece = rng.choice(pieces)
        kind = rng.random()
        if kind < 0.15:
            case: Tree = {"live": [{"tilt": {"axis": rng.choice([[0, 1, 0], [1, 0, 0], [0, -1, 0.2]])}}]}
        elif kind < 0.3 and any(each.held for each in pieces):
            held = rng.choice([each.held[0] for each in pieces if each.held])
            case = {"settlement": {"on": {"group": held, "index": 0}, "direction": rng.choice([[1, 0, 0], [0, 0, -1]])}}
        else:
            case = {"live": [_live(rng, piece) for _ in range(rng.choice([1, 1, 2]))]}
            if rng.random() < 0.2:
                case["dead"] = [{"gravity": [0, 0, -9.81]}, {"force": [0, 0, -500.0], "on": _one_block(rng, piece)}]
        cases[f"case{number}"] = case
    return cases


def _analysis(rng: Random) -> Tree:
    """Only what goes together: the reader refuses the rest."""
    rules, weights = ["associative", "non_associative", "dilatancy", "livesley"], (6, 2, 1, 1)
    analysis: Tree = {"flow_rule": rng.choices(rules, weights)[0]}
    associative = analysis["flow_rule"] == "associative"
    if rng.random() < 0.25 and analysis["flow_rule"] in ("associative", "non_associative"):
        analysis["contact_model"] = "convex"
    elif rng.random() < 0.1 and associative:  # a choice that is gone; seeds keep the decks they had
        pass
    elif rng.random() < 0.3 and associative:
        analysis["solver"] = "clarabel"
    analysis["accuracy"] = rng.choice(["draft", "standard", "standard", "reference"])
    analysis["reductions"] = max(rng.random() for _ in range(4)) < 0.9  # four numbers: seeds keep the decks they had
    return analysis
