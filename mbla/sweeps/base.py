"""The base deck of a sweep, checked for what the sweep does to it, and the keys of its points."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from mbla.deck.deck import Deck, check_regular, read_deck
from mbla.deck.parameter_keys import path_of_key, unit_of, vector_at
from mbla.deck.suggestions import unknown
from mbla.deck.text.overrides import LABEL, RefusedError
from mbla.deck.text.tree import Tree
from mbla.errors import DeckError, Fault, FileError, KeyPath, Message, Place
from mbla.sweeps.base_rules import base_faults
from mbla.sweeps.design.design import DesignPoint, Sources, TurnedVector
from mbla.sweeps.file.content import DIRECTIONS, way_of
from mbla.sweeps.file.read import Sweep
from mbla.sweeps.file.rules import key_places
from mbla.sweeps.identity import deck_fingerprint, effective_tree
from mbla.sweeps.plan import override_texts


@dataclass(frozen=True)
class Base:
    """A base deck with the values in it that hold for every point.

    sweep       : the sweep file
    path        : absolute path of the deck
    fixed       : ``key.path=value`` texts: `set` of the sweep file, then ``--set``
    deck        : checked, with the fixed values
    tree        : the same as read, not evaluated
    cases       : names of the load cases to solve, in the order of the results
    paths       : key paths of each parameter in the deck, by the parameter's name
    fingerprint : hash of what the deck means (``identity.py``)
    """

    sweep: Sweep
    path: Path
    fixed: tuple[str, ...]
    deck: Deck
    tree: Tree
    cases: tuple[str, ...]
    paths: Mapping[str, tuple[KeyPath, ...]]
    fingerprint: str

    @cached_property
    def units(self) -> Mapping[str, str]:
        """Unit of each parameter by its name: the deck's, or what the sweep file says; degrees for directions."""
        return {name: self._unit(name) for name in self.paths}

    @cached_property
    def vectors(self) -> Mapping[str, TurnedVector]:
        """Vector of the base deck that each parameter with directions turns, by its name."""
        parameters = self.sweep.content.parameters
        turning = [name for name in self.paths if way_of(parameters[name]) in DIRECTIONS]
        found = {name: vector_at(self.deck.content, self.paths[name][0]) for name in turning}
        return {name: vector for name, vector in found.items() if vector is not None}

    @property
    def sources(self) -> Sources:
        """What the design is made from."""
        known: Mapping[str, object] = self.tree.data.get("parameters", {})
        return Sources(self.sweep.content, self.vectors, self.units, known, self.sweep.fault_at)

    def _unit(self, name: str) -> str:
        parameter = self.sweep.content.parameters[name]
        if way_of(parameter) in DIRECTIONS:
            return "degree"
        if any(isinstance(value, str) for value in parameter.values or ()):
            return parameter.unit  # a text may bring a unit of its own
        return unit_of(self.paths[name], self.deck.units) or parameter.unit


def read_base(sweep: Sweep) -> Base:
    """Read the base deck and check what the sweep file states of it.

    Raises DeckError with every fault: of the deck as its own, of the sweep file at its place there.
    """
    path = _deck_path(sweep)
    fixed = (*override_texts(sweep.content.set), *sweep.overrides)
    try:
        deck = read_deck(path, fixed)
    except DeckError as error:
        raise DeckError([_at_its_place(sweep, fault) for fault in error.faults]) from error
    tree = effective_tree(path, fixed)
    cases = tuple(sweep.content.cases or deck.content.load_cases)
    known, faults = deck.content.load_cases, list[Fault]()
    for index, case in enumerate(sweep.content.cases or ()):
        if case not in known:
            message = Message("unknown-name", unknown("load case", case, known, "known"))
            faults.append(sweep.fault_at(("cases", index), message))
    paths = _paths(sweep, tree, faults)
    if faults:
        raise DeckError(faults)
    base = Base(sweep, path.resolve(), fixed, deck, tree, cases, paths, deck_fingerprint(deck, tree))
    if faults := base_faults(base):
        raise DeckError(faults)
    return base


def _deck_path(sweep: Sweep) -> Path:
    """Path of the base deck; DeckError at its name if it cannot be opened."""
    name = sweep.content.deck
    try:
        if "\0" in name or len(name) > 4000:
            raise FileError("bad-file-name", "is not a file name")
        path = sweep.path.parent / name
        check_regular(path)
        if path.resolve() == sweep.path.resolve():
            raise FileError("sweep-file-and-deck", "is the sweep file itself: name the deck that it varies")
    except FileError as error:
        raise DeckError([sweep.fault_at(("deck",), error.message)]) from error
    return path


def _at_its_place(sweep: Sweep, fault: Fault) -> Fault:
    """A fault of a value that `set` of the sweep file brings, at its place there; others as they are."""
    if fault.place.file != LABEL:
        return fault
    keys = list(sweep.content.set)
    number = fault.place.line - len(keys)
    if number > 0:  # those of the command line are counted from 1 there
        return Fault(Place(LABEL, number, fault.place.column), fault.key, fault.message, fault.value)
    key = keys[fault.place.line - 1]
    here = sweep.fault_at(("set", key), fault.message)
    below = fault.key.replace("[", ".").replace("]", "")
    return here if below == key.strip() else sweep.fault_at(("set", key), fault.message.around(before=f"{fault.key}: "))


def _paths(sweep: Sweep, tree: Tree, faults: list[Fault]) -> dict[str, tuple[KeyPath, ...]]:
    """Key paths of each parameter; what the deck does not have goes to ``faults``."""
    found: dict[str, tuple[KeyPath, ...]] = {}
    for name, parameter in sweep.content.parameters.items():
        for place, key in key_places(name, parameter):
            try:
                found[name] = (*found.get(name, ()), path_of_key(tree.data, key))
            except RefusedError as refusal:
                remedy = "" if parameter.key or "." in name else "; or give the key path in the deck with key"
                faults.append(sweep.fault_at(place, refusal.message.around(after=remedy)))
    return found


def check_points(base: Base, points: Sequence[DesignPoint]) -> None:
    """Refuse a sweep whose first, middle and last points are all refused as decks.

    One that is readable is enough: corners of a design may be no structure, and their rows then say so.

    Raises DeckError with what is wrong with the first point.
    """
    tried = list({point.number: point for point in (points[0], points[len(points) // 2], points[-1])}.values())
    refused: list[DeckError] = []
    for point in tried:
        try:
            read_deck(base.path, (*base.fixed, *override_texts(point.settings)), expected=False)
        except DeckError as error:
            refused.append(error)
        else:
            return
    where = "first, middle and last point" if len(tried) > 1 else "only point"
    said = f"the deck is refused at the {where}: "
    befores = ((fault, f"{said}{fault.key}: " if fault.key else said) for fault in refused[0].faults)
    messages = [fault.message.around(before=before) for fault, before in befores]
    raise DeckError([base.sweep.fault_at(("parameters",), message) for message in messages])
