"""Names that one part of the deck gives and another uses: materials, joint laws, groups, load cases.

They are looked up in the deck as read rather than in its checked types, so that a wrong name is reported with
every other fault.

So are the names of files: meshes and tables.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from mbla.deck.kinds.kinds import in_order
from mbla.deck.kinds.load_key import NAMED, loads_that
from mbla.deck.sections.blocks import ITEM_KINDS
from mbla.deck.sections.loads import LOAD_KEYS
from mbla.deck.sections.materials import BUILT_IN
from mbla.deck.sections.selectors import GROUND
from mbla.deck.sections.soil import SOIL, laws_of_soil
from mbla.deck.suggestions import unknown
from mbla.deck.text.tree import Tree
from mbla.errors import Fault, KeyPath, Message


@dataclass(frozen=True)
class Reference:
    """Where names are used: a key path in which ``#`` stands for every item and ``*`` for every key."""

    path: str
    kind: str
    also: tuple[str, ...] = ()


LOADS = ("loads.*", "load_cases.*.dead", "load_cases.*.live")
"""Where lists of loads stand."""
SELECTORS = (
    "contacts.overrides.#.between.#",
    "supports.#.blocks",
    "masses.#.on",
    "fill.*.on",
    *(f"{loads}.#.on" for loads in LOADS),
    "load_cases.*.settlement.on",
    "load_cases.*.settlement.#.on",
    "load_cases.*.objective.force.from",
    "load_cases.*.objective.force.on",
    "load_cases.*.pushover.control.on",
    "load_cases.*.time_history.forces.#.on",
    "load_cases.*.time_history.record.points.*.on",
    "load_cases.*.time_history.record.interfaces.*.between.#",
    "load_cases.*.time_history.rigid.#",
    "symmetry.#.halves",
    "ties.#.on.#",
    "ties.#.ring.around",
    "strengthen.candidates.#.across.between.#",
    "strengthen.candidates.#.ring.around",
    "strengthen.candidates.#.vertical.down",
    "strengthen.candidates.#.on.#",
)
"""Where blocks are chosen."""
WITH_GROUND = (
    "contacts.overrides.#.between.#",
    "contacts.overrides.#.between.#.#",
    "load_cases.*.time_history.record.interfaces.*.between.#",
    "ties.#.on.#",
    "strengthen.candidates.#.on.#",
)
"""Where ground may be meant; of points of ties alone, not among blocks."""
REFERENCES = (
    Reference("blocks.#.*.material", "material"),
    Reference("blocks.#.*.joint", "joint law", BUILT_IN),
    Reference("contacts.joint", "joint law", BUILT_IN),
    Reference("contacts.overrides.#.joint", "joint law", BUILT_IN),
    *(
        Reference(f"blocks.#.{kind.name}.{place}", "material")
        for kind in in_order(ITEM_KINDS)
        for place in kind.materials
    ),
    Reference("supports.#.joint", "joint law", BUILT_IN),
    Reference("fill.*.material", "material"),
    Reference("fill.*.water.saturated", "material"),
    *(
        Reference(f"{place}{form}", "group", (GROUND,) if f"{place}{form}" in WITH_GROUND else ())
        for place in (*SELECTORS, "groups.*")
        for form in ("", ".group", ".#", ".#.group")
    ),
    *(Reference(f"{loads}.#.{NAMED}", "load") for loads in LOADS),
    *(Reference(f"{loads}.#.through", "fill") for loads in LOADS),
    *(
        Reference(f"{loads}.#.{kind.name}.{key}", what)
        for loads in LOADS
        for kind in in_order(LOAD_KEYS)
        for key, what in kind.names.items()
    ),
)


def check_references(tree: Tree) -> Iterator[Fault]:
    """Faults of all names that nothing in the deck has."""
    data = tree.data
    known: dict[str, list[str]] = {
        "material": _keys(data.get("materials")),
        "joint law": _keys(data.get("joints")),
        "load": _keys(data.get("loads")),
        "fill": _keys(data.get("fill")),
        "vehicle": _keys(data.get("vehicles")),
        "group": list(dict.fromkeys(groups(data))),
    }
    choices = _keys(data.get("groups"))
    for reference in REFERENCES:
        names = dict.fromkeys((*known[reference.kind], *reference.also))
        if reference.path in SELECTORS or reference.path.removesuffix(".#") in SELECTORS:
            names |= dict.fromkeys(choices)
        for path, name in find(data, reference.path.split(".")):
            if isinstance(name, str) and name not in names:
                yield tree.fault(path, Message("unknown-name", unknown(reference.kind, name, names, "known")))
    cases = _keys(data.get("load_cases"))
    strengthen = data.get("strengthen")
    required = strengthen.get("required") if isinstance(strengthen, dict) else None
    for place, section in ((("expected",), data.get("expected")), (("strengthen", "required"), required)):
        for case in (name for name in _keys(section) if name not in cases):
            words = unknown("load case", case, cases, "known")
            yield tree.fault((*place, case), Message("unknown-name", words), at_key=True)
    for path, case in find(data, ["find", "load_case"]):
        if isinstance(case, str) and case not in cases:
            yield tree.fault(path, Message("unknown-name", unknown("load case", case, cases, "known")))
    for law in _keys(data.get("joints")):
        if law in BUILT_IN:
            message = f"{law} is a joint law that every deck knows: choose another name, or use it without declaring it"
            yield tree.fault(("joints", law), Message("reserved-name", message), at_key=True)
    for name in choices:
        if name == GROUND or name in known["group"]:
            words = f"{name} is a group of blocks already, or ground: choose another name"
            yield tree.fault(("groups", name), Message("reserved-name", words), at_key=True)
    yield from _names_of_soil(tree, list(fills_of_cells(data)))
    for path, group in find(data, ["blocks", "#", "*", "group"]):
        if group == GROUND:
            words = f"{GROUND} stands for ground planes in contacts.overrides: choose another name"
            yield tree.fault(path, Message("reserved-name", words))


def _names_of_soil(tree: Tree, cells: list[str]) -> Iterator[Fault]:
    """Faults of names that soil gives its cells and their joint laws, and something else has."""
    of_items = [group for _, group in groups_of_items(tree.data)]
    soils = [group for kind, group in groups_of_items(tree.data) if kind == SOIL]
    for name in cells:
        if name == GROUND or name in of_items:
            words = f"{name} is a group of blocks already, or ground: the cells of a fill are a group of its name"
            yield tree.fault(("fill", name), Message("reserved-name", words), at_key=True)
    for name in dict.fromkeys(soils):
        if of_items.count(name) > 1:
            items = find(tree.data, ["blocks", "#", SOIL])
            *_, path = (path for path, item in items if isinstance(item, dict) and item.get("group", SOIL) == name)
            words = f"{name} is the group of other items as well: soil has one of its own"
            yield tree.fault(path, Message("reserved-name", words), at_key=True)
    laws = {law for name in (*cells, *soils) for law in laws_of_soil(name)}
    for law in _keys(tree.data.get("joints")):
        if law in laws:
            yield tree.fault(("joints", law), Message("reserved-name", f"{law} is the law of a soil"), at_key=True)


def fills_of_cells(data: dict[str, Any]) -> Iterator[str]:
    """Names of fills that are soil of cells."""
    fills = data.get("fill")
    for name, fill in (fills if isinstance(fills, dict) else {}).items():
        if isinstance(fill, dict) and fill.get("cells") is not None:
            yield name


def unused_names(data: dict[str, Any]) -> Iterator[tuple[str, str]]:
    """(section, name) of materials, joint laws, named loads and vehicles that nothing uses."""
    kinds = {"materials": "material", "joints": "joint law", "loads": "load", "vehicles": "vehicle"}
    for section, kind in kinds.items():
        used = {
            name
            for reference in REFERENCES
            if reference.kind == kind
            for _, name in find(data, reference.path.split("."))
            if isinstance(name, str)
        }
        yield from ((section, name) for name in _keys(data.get(section)) if name not in used)


def groups(data: dict[str, Any]) -> Iterator[str]:
    """Names of the groups that the items of `blocks` make, and of those of soil above arches."""
    yield from (group for _, group in groups_of_items(data))
    yield from fills_of_cells(data)


def groups_of_items(data: dict[str, Any]) -> Iterator[tuple[str, str]]:
    """Kind of each item of `blocks`, and names of the groups that it makes."""
    for (_, _, kind), item in find(data, ["blocks", "#", "*"]):
        if isinstance(item, dict) and isinstance(kind, str) and kind in ITEM_KINDS:
            group = item.get("group", kind)
            if isinstance(group, str):
                yield kind, group
                yield from (
                    (kind, group + side.suffix) for side in ITEM_KINDS[kind].groups if item.get(side.key) in side.values
                )


def find(data: Any, pattern: list[str], path: KeyPath = ()) -> Iterator[tuple[KeyPath, Any]]:
    """Paths and values that fit a pattern."""
    if not pattern:
        yield path, data
        return
    key, rest = pattern[0], pattern[1:]
    below: Iterable[tuple[str | int, Any]] = ()
    if key == "#":
        below = enumerate(data) if isinstance(data, list) else ()
    elif isinstance(data, dict):
        below = data.items() if key == "*" else [(key, data[key])] if key in data else ()
    for step, value in below:
        yield from find(value, rest, (*path, step))


def _keys(section: Any) -> list[str]:
    return list(section) if isinstance(section, dict) else []


SIDE_FILES = (
    *(f"blocks.#.{kind.name}.{key}" for kind in in_order(ITEM_KINDS) for key in kind.files),
    "supports.#.surface.file",
    "contacts.table",
    "load_cases.*.time_history.motion.file",
    "load_cases.*.time_history.motion.#.file",
    "load_cases.*.time_history.forces.#.file",
    *(f"{loads}.#.{key}" for loads in LOADS for key in loads_that(lambda kind: kind.is_file)),
)
"""Key paths, in which ``#`` stands for every item and ``*`` for every key."""


def side_files(value: Any, at: KeyPath = ()) -> Iterator[tuple[KeyPath, str]]:
    """Key paths and names of the files that a value of the deck names; ``at`` is where it stands, () the full deck."""
    for pattern in SIDE_FILES:
        words = pattern.split(".")
        if len(words) >= len(at) and all(
            isinstance(key, int) if word == "#" else word in ("*", key) for word, key in zip(words, at, strict=False)
        ):
            for path, name in find(value, words[len(at) :], at):
                if isinstance(name, str):
                    yield path, name
