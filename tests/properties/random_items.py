"""Random items of a deck, small ones of every kind that needs no file, each with what it stands on."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from random import Random
from typing import Any, TypeAlias

Tree: TypeAlias = dict[str, Any]


@dataclass(frozen=True)
class Piece:
    """Items of a deck.

    items    : content of ``blocks``
    grounded : whether they stand on ground at z = 0
    groups   : groups whose blocks are free
    labels   : names of positions that the blocks of the first group have
    held     : groups whose blocks are fixed
    """

    items: list[Tree]
    grounded: bool
    groups: list[str]
    labels: list[str] = field(default_factory=list)
    held: list[str] = field(default_factory=list)


def _pile(rng: Random, name: str) -> Piece:
    items, z, x, y = [], 0.0, 0.0, 0.0
    for _ in range(rng.randint(1, 4)):
        b, d, h = (round(rng.uniform(0.3, 1.2), 2) for _ in range(3))
        item: Tree = {"group": name, "min": [x - b / 2, y - d / 2, z], "max": [x + b / 2, y + d / 2, z + h]}
        if rng.random() < 0.4:
            angle = rng.choice([0, 17.0, 45.0, -30.0])
            item["transform"] = [{"rotate": {"axis": [0, 0, 1], "angle": angle, "about": [x, y, 0]}}]
        items.append({"box": item})
        x, y, z = x + b * rng.uniform(-0.25, 0.25), y + d * rng.uniform(-0.25, 0.25), z + h
    return Piece(items, True, [name])


def _wedge(rng: Random, name: str) -> Piece:
    b, h = rng.uniform(0.5, 1.5), rng.uniform(0.5, 2.0)
    vertices = [[0, 0, 0], [b, 0, 0], [0.4 * b, 0, h], [0, 1, 0], [b, 1, 0], [0.4 * b, 1, h]]
    faces = [[0, 1, 2], [3, 4, 5], [0, 1, 4, 3], [1, 2, 5, 4], [0, 2, 5, 3]]
    return Piece([{"polyhedron": {"group": name, "vertices": vertices, "faces": faces}}], True, [name])


def _wall(rng: Random, name: str) -> Piece:
    bond = rng.choice(["running", "stack", "english", "flemish", "header"])
    leaves = 1 if bond in ("running", "stack") else 2
    item: Tree = {"group": name, "unit": [0.4, 0.2, 0.2], "length": rng.choice([0.8, 1.0, 1.2])}
    item |= {"courses": rng.randint(2, 4), "bond": bond, "leaves": leaves, "start": rng.choice(["full", "half"])}
    if bond == "running" and rng.random() < 0.3:
        item["irregular"] = {"seed": rng.randint(0, 99), "variation": 0.2}
    return Piece([{"wall": item}], True, [name], ["course", "unit"])


def _walls(rng: Random, name: str) -> Piece:
    item = {
        "group": name,
        "unit": [0.4, 0.2, 0.2],
        "courses": rng.randint(2, 3),
        "plan": [[0, 0], [1.0, 0], [1.0, 0.8]],
    }
    return Piece([{"walls": item}], True, [name], ["course", "segment"])


def _arch(rng: Random, name: str) -> Piece:
    shape = rng.choice(["semicircular", "segmental", "pointed", "elliptic", "catenary", "basket"])
    item: Tree = {"group": name, "shape": shape, "span": 2.0, "thickness": rng.choice([0.35, 0.5]), "width": 0.6}
    item["voussoirs"] = rng.randint(5, 11)
    if shape == "segmental":
        item["embrace"] = 120
    elif shape != "semicircular":
        item["rise"] = 1.3 if shape == "pointed" else 0.7
    if rng.random() < 0.2:
        item["skew"] = 20
    if rng.random() < 0.2:
        item["units_across"] = 2
    springers = rng.choice(["ground", "blocks", "piers"])
    if springers == "piers":
        item["piers"] = {"height": 0.4, "width": 0.8, "courses": 1}
        item["transform"] = [{"translate": [0, 0, 0.4]}]
        return Piece([{"arch": item}], True, [name], ["voussoir"])
    item["springers"] = springers
    held = [f"{name}_springers"] if springers == "blocks" else []
    return Piece([{"arch": item}], False, [name], ["voussoir"], held)


def _column(rng: Random, name: str) -> Piece:
    item = {"group": name, "radius": 0.4, "top_radius": 0.3, "height": 1.6, "drums": rng.randint(1, 4)}
    return Piece([{"column": item | {"sides": rng.choice([4, 6, 8])}}], True, [name], ["drum"])


def _stack(rng: Random, name: str) -> Piece:
    item = {"group": name, "block": [1.0, 0.5, 0.2], "count": rng.randint(2, 4), "shift": [0.08, 0.0]}
    return Piece([{"stack": item}], True, [name], ["drum"])


def _trilithon(rng: Random, name: str) -> Piece:
    item = {"group": name, "upright": [0.5, 0.5, rng.uniform(0.8, 1.8)], "opening": 0.8, "lintel": [1.9, 0.5, 0.4]}
    return Piece([{"trilithon": item}], True, [name], ["unit"])


def _bridge(rng: Random, name: str) -> Piece:
    item: Tree = {"group": name, "spans": [2.0], "shape": "segmental", "rise": 0.6, "thickness": 0.4, "voussoirs": 7}
    item |= {"width": 0.8, "abutments": {"width": 0.8, "height": 0.5, "courses": 1}, "spandrels": "none"}
    if rng.random() < 0.5:
        item |= {"spandrels": "full", "unit": [0.6, 0.3], "cover": 0.2}
    return Piece([{"bridge": item | {"transform": {"translate": [0, 0, 0.5]}}}], True, [name], ["voussoir"])


def _dome(rng: Random, name: str) -> Piece:
    item: Tree = {"group": name, "span": 2.0, "thickness": 0.4, "rings": 2, "segments": rng.choice([4, 6])}
    item["bond"] = rng.choice(["running", "stack"])
    item["springers"] = rng.choice(["ground", "blocks"])
    if rng.random() < 0.3:
        item["oculus"] = 0.6
    held = [f"{name}_springers"] if item["springers"] == "blocks" else []
    return Piece([{"dome": item}], False, [name], ["ring", "segment"], held)


def _barrel(rng: Random, name: str) -> Piece:
    item: Tree = {"group": name, "shape": "segmental", "embrace": 120, "span": 2.0, "length": 1.0, "thickness": 0.3}
    item |= {"courses": 5, "unit": 0.5, "bond": rng.choice(["running", "stack"])}
    item["springers"] = rng.choice(["ground", "blocks"])
    held = [f"{name}_springers"] if item["springers"] == "blocks" else []
    return Piece([{"barrel_vault": item}], False, [name], ["course", "unit"], held)


def _cross(rng: Random, name: str) -> Piece:
    item: Tree = {"group": name, "shape": "semicircular", "bay": [2.0, 2.0], "thickness": 0.35, "courses": 5}
    return Piece([{"cross_vault": item | {"unit": 0.8, "springers": "blocks"}}], False, [name], ["course"])


def _pavilion(rng: Random, name: str) -> Piece:
    item: Tree = {"group": name, "shape": "semicircular", "bay": [2.0, 2.0], "thickness": 0.35, "courses": 5}
    return Piece([{"pavilion_vault": item | {"unit": 0.8, "springers": "ground"}}], False, [name], ["course"])


def _stair(rng: Random, name: str) -> Piece:
    item: Tree = {"group": name, "treads": rng.randint(2, 4), "inner_radius": 0.3, "outer_radius": 1.2, "rise": 0.2}
    item |= {"angle": 30, "overlap": 6, "rebate": 0.05, "built_in": 0.2, "wall": rng.choice(["shelf", "pocket"])}
    return Piece([{"spiral_stair": item | {"foot": "ground"}}], False, [name], ["tread"])


KINDS: dict[str, Callable[[Random, str], Piece]] = {
    "pile": _pile,
    "wedge": _wedge,
    "wall": _wall,
    "walls": _walls,
    "arch": _arch,
    "column": _column,
    "stack": _stack,
    "trilithon": _trilithon,
    "bridge": _bridge,
    "dome": _dome,
    "barrel_vault": _barrel,
    "cross_vault": _cross,
    "pavilion_vault": _pavilion,
    "spiral_stair": _stair,
}
LIKELY = (6, 2, 5, 2, 4, 2, 3, 3, 1, 1, 1, 0.5, 0.5, 1)
"""how often each kind is taken; vaults and domes take longer"""
