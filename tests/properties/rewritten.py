"""Decks that say the same in another way: other units, moved, half turned, shuffled, copies written out."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from random import Random
from typing import Any, get_args, get_origin

import numpy as np
from pydantic import BaseModel
from pydantic.fields import FieldInfo

from mbla.arrays import FloatArray
from mbla.deck.content import DeckContent
from mbla.deck.quantities import RealNumber
from tests.properties.random_items import Tree

SIZES = {
    "m": 1.0,
    "mm": 1e-3,
    "ft": 0.3048,
    "N": 1.0,
    "kN": 1e3,
    "lbf": 4.4482216152605,
    "kg": 1.0,
    "t": 1e3,
    "lb": 0.45359237,
}
POWERS = {
    "length": (1, 0, 0),
    "force": (0, 1, 0),
    "moment": (1, 1, 0),
    "force_per_length": (-1, 1, 0),
    "mass": (0, 0, 1),
    "stress": (-2, 1, 0),
    "density": (-3, 0, 1),
    "unit_weight": (-3, 1, 0),
    "acceleration": (1, 0, 0),
}
VECTORS = ("direction", "normal", "axis", "force", "gravity", "acceleration", "moment", "force_per_length", "slide")
"""keys whose three numbers turn with the structure"""
DIRECTIONS = (*VECTORS, "along", "towards")
PLACES = ("at", "from", "to", "point", "about", "path", "box")


def in_units(deck: Tree, length: str, force: str, mass: str) -> Tree:
    """The deck, in m, N and kg, in other units."""
    sizes = (SIZES[length], SIZES[force], SIZES[mass])

    def converted(value: float, dimension: str) -> float:
        powers = POWERS.get(dimension, (0, 0, 0))
        return value / float(np.prod([size**power for size, power in zip(sizes, powers, strict=True)]))

    other: Tree = _walk(deck, DeckContent, (), converted)
    return other | {"units": {"length": length, "force": force, "mass": mass}}


def _walk(value: Any, annotation: Any, extra: tuple[Any, ...], change: Callable[[float, str], float]) -> Any:
    """A tree with every number changed that its type gives a dimension."""
    if isinstance(value, dict):
        return _walk_mapping(value, annotation, change)
    if isinstance(value, list):
        inner = list(map(get_args, _choices(annotation, (list, tuple))))
        kinds = next((args for args in inner if len(args) == len(value) and len(args) > 1), inner[0])
        each = kinds if len(kinds) == len(value) else kinds[:1] * len(value)
        return [_walk(part, kind, (), change) for part, kind in zip(value, each, strict=True)]
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return value
    found = [note for note in (*extra, *_notes(annotation)) if isinstance(note, RealNumber)]
    return change(value, found[0].dimension) if found else value


def _walk_mapping(value: Tree, annotation: Any, change: Callable[[float, str], float]) -> Tree:
    models = [kind for kind in _leaves(annotation) if isinstance(kind, type) and issubclass(kind, BaseModel)]
    for model in models:
        fields = {_key(name, info): info for name, info in model.model_fields.items()}
        if set(value) <= set(fields):
            return {
                key: _walk(part, fields[key].annotation, tuple(fields[key].metadata), change)
                for key, part in value.items()
            }
    kind = get_args(_choices(annotation, (dict,))[0])[1]
    return {key: _walk(part, kind, (), change) for key, part in value.items()}


def _key(name: str, info: FieldInfo) -> str:
    return info.alias or name


def _leaves(annotation: Any) -> Iterator[Any]:
    """Alternatives of a type, without their annotations."""
    origin = get_origin(annotation)
    if origin in (list, tuple, dict) or origin is None:
        yield annotation
        return
    for part in get_args(annotation):
        if isinstance(part, type) or get_origin(part) is not None:
            yield from _leaves(part)


def _choices(annotation: Any, origins: tuple[Any, ...]) -> list[Any]:
    return [kind for kind in _leaves(annotation) if get_origin(kind) in origins]


def _notes(annotation: Any) -> Iterator[Any]:
    for part in getattr(annotation, "__metadata__", ()):
        yield part
    for part in get_args(annotation):
        yield from _notes(part)


def moved(deck: Tree, turn: FloatArray, angle: Tree, shift: tuple[float, float, float]) -> Tree:
    """The whole, turned and then shifted; ``turn`` the matrix of ``angle`` (axis and degrees, about the origin)."""
    by = np.array(shift)

    def go(value: Any, key: str) -> Any:
        if (
            key == "blocks"
            and isinstance(value, list)
            and isinstance(value[0], dict)
            and len(value[0]) == 1
            and _is_item(value[0])
        ):
            return [_moved_item(item, turn, angle, shift) for item in value]
        if isinstance(value, dict):
            if key == "ground":
                value = _general(value)
            return {name: go(part, name) for name, part in value.items()}
        if _is_vector(value) and key in DIRECTIONS:
            return [float(x) for x in turn @ np.array(value)]
        if _is_vector(value) and key in PLACES:
            return [float(x) for x in turn @ np.array(value) + by]
        return [go(part, key) for part in value] if isinstance(value, list) else value

    if "load_cases" in deck:
        deck = deck | {"load_cases": {name: _with_gravity(case) for name, case in deck["load_cases"].items()}}
    return {key: go(value, key) for key, value in deck.items()}


def _with_gravity(case: Tree) -> Tree:
    return case if "dead" in case else {"dead": [{"gravity": [0.0, 0.0, -9.81]}]} | case


def _general(ground: Tree) -> Tree:
    for number, axis in enumerate("xyz"):
        if axis in ground:
            unit = [float(number == each) for each in range(3)]
            return {"point": [ground[axis] * part for part in unit], "normal": unit}
    return ground


def _is_item(value: Tree) -> bool:
    body = next(iter(value.values()))
    return isinstance(body, dict) and "group" in body


def _is_vector(value: Any) -> bool:
    return isinstance(value, list) and len(value) == 3 and all(isinstance(part, (int, float)) for part in value)


def _moved_item(item: Tree, turn: FloatArray, angle: Tree, shift: tuple[float, float, float]) -> Tree:
    kind, body = next(iter(item.items()))
    own = body.get("transform", [])
    steps = [*(own if isinstance(own, list) else [own]), {"rotate": angle}, {"translate": list(shift)}]
    body = body | {"transform": steps}
    if "repeat" in body and "translate" in body["repeat"]:
        step = turn @ np.array(body["repeat"]["translate"])
        body["repeat"] = body["repeat"] | {"translate": [float(x) for x in step]}
    return {kind: body}


def shuffled(deck: Tree, seed: int) -> Tree:
    """Items in another order; only for decks that name no block by its index."""
    items = list(deck["blocks"])
    Random(seed).shuffle(items)
    return deck | {"blocks": items}


def copies_written_out(deck: Tree) -> Tree:
    """Every repetition by translation as items of their own, the groups the same."""
    items = []
    for item in deck["blocks"]:
        kind, body = next(iter(item.items()))
        repeat = body.get("repeat")
        body = {key: part for key, part in body.items() if key != "repeat"}
        own = body.get("transform", [])
        own = own if isinstance(own, list) else [own]
        for number in range(repeat["count"] if repeat else 1):
            shift = [number * part for part in repeat["translate"]] if repeat else [0, 0, 0]
            items.append({kind: body | {"transform": [*own, {"translate": shift}]}})
    return deck | {"blocks": items}
