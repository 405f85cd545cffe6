"""Random assemblies as decks: cells of a box, walls, arches, stacks, with random joints and loads."""

from __future__ import annotations

import math
from random import Random
from typing import Any

from tests.properties.cells import cells_of_planes, cells_of_voronoi, indexed
from tests.properties.random_items import KINDS, Piece, Tree

SHARES = {
    "planes": 5,
    "voronoi": 4,
    "wall": 4,
    "arch": 4,
    "pile": 3,
    "stack": 2,
    "column": 1,
    "trilithon": 1,
    "wedge": 1,
    "walls": 1,
    "bridge": 0.5,
    "dome": 0.5,
    "barrel_vault": 0.5,
}
"""kinds of assemblies and how often each is taken"""
SMALL = {"planes": 3, "voronoi": 2, "pile": 3, "stack": 2, "trilithon": 1, "wedge": 1}
"""kinds of which small ones are made, of at most five blocks"""


def assembly(seed: int, small: bool = False) -> Tree:
    """A deck of associative flow; the same for the same seed. ``small``: five blocks at most."""
    rng = Random(f"certificates {seed}")
    shares = SMALL if small else SHARES
    kind = rng.choices(list(shares), list(shares.values()))[0]
    piece = _cells(rng, kind, small) if kind in ("planes", "voronoi") else KINDS[kind](rng, kind)
    laws = {name: _law(rng) for name in ("one", "other")}
    return {
        "mbla": 1,
        "title": f"{kind} {seed}",
        "materials": {"stone": {"density": rng.choice([1600, 2000, 2600])}},
        "joints": laws,
        "blocks": [_of_stone(item) for item in piece.items],
        "contacts": {"joint": "one"} | _overrides(rng, piece),
        "supports": [{"ground": {"z": 0}}] if piece.grounded else [],
        "load_cases": {"collapse": _loads(rng, piece)},
        "analysis": {"flow_rule": "associative"},
        "output": {"vtu": False},
    }


def crushes(deck: Tree) -> bool:
    """Whether joints of a deck have a compressive strength."""
    return any("compressive_strength" in law for law in deck["joints"].values())


def without_crushing(deck: Tree) -> Tree:
    """The same deck with joints that do not crush, whose conditions are those of points alone."""
    laws = {
        name: {key: law[key] for key in law if key != "compressive_strength"} for name, law in deck["joints"].items()
    }
    return deck | {"joints": laws}


def kind_of(deck: Tree) -> str:
    """What a deck is an assembly of."""
    return str(deck["title"]).split(" ", maxsplit=1)[0]


def _of_stone(item: Tree) -> Tree:
    kind, body = next(iter(item.items()))
    body = body | {"material": "stone"}
    if "irregular" in body:
        body.pop("start")  # random units leave no half ones to start with
    return {kind: body}


def _cells(rng: Random, kind: str, small: bool) -> Piece:
    size = (rng.uniform(0.6, 2.5), rng.uniform(0.4, 1.5), rng.uniform(0.6, 2.5))
    count = rng.randint(2, 4 if small else 14)
    cells = (cells_of_planes if kind == "planes" else cells_of_voronoi)(rng, size, count)
    items: list[Tree] = []
    for cell in cells:
        vertices, faces = indexed(cell, max(size))
        items.append({"polyhedron": {"group": kind, "vertices": vertices, "faces": faces}})
    return Piece(items, True, [kind])


def _law(rng: Random) -> Tree:
    friction = round(rng.uniform(0.15, 1.1), 3)
    law: Tree = {"friction": friction}
    if rng.random() < 0.3:
        cohesion = round(10 ** rng.uniform(2.0, 4.5), 1)
        law["cohesion"] = cohesion
        if rng.random() < 0.5:
            law["tensile_strength"] = round(rng.uniform(0.0, 0.9) * cohesion / friction, 1)
    if rng.random() < 0.25:
        law["compressive_strength"] = round(10 ** rng.uniform(5.0, 7.0), 0)
    return law


def _overrides(rng: Random, piece: Piece) -> Tree:
    group = rng.choice(piece.groups)
    fits: list[Tree] = [
        {"orientation": "head"},
        {"orientation": "bed"},
        {"between": [{"group": group, "index": 0}, group]},
        {"orientation": {"normal": [1, 0, 1], "within": 50}},
    ]
    return {"overrides": [{"joint": "other"} | rng.choice(fits)]} if rng.random() < 0.5 else {}


def _loads(rng: Random, piece: Piece) -> Tree:
    block = {"group": rng.choice(piece.groups), "index": 0}
    live: list[Tree] = []
    if rng.random() < 0.75:
        live.append({"acceleration": _direction(rng, flat=rng.random() < 0.5)})
    if not live or rng.random() < 0.25:
        live.append({"force": [round(2000.0 * part, 1) for part in _direction(rng, flat=False)], "on": block})
    loads: dict[str, Any] = {"live": live}
    if rng.random() < 0.2:
        push = [round(500.0 * part, 1) for part in _direction(rng, flat=False)]
        loads["dead"] = [{"gravity": [0, 0, -9.81]}, {"force": push, "on": block}]
    return loads


def _direction(rng: Random, flat: bool) -> list[float]:
    """A random unit vector, to four digits; ``flat``: along x or y, as loads often are."""
    if flat:
        return rng.choice([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0]])
    parts = [rng.gauss(0, 1) for _ in range(3)]
    length = math.hypot(*parts)
    return [round(part / length, 4) for part in parts]
