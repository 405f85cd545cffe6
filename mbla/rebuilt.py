"""The model of a result file against the deck in it: it is read and built once more, and must come out the same.

Residuals and bounds prove an answer for the arrays of a file. That these arrays are the structure that its deck
describes is shown by the deck: blocks, contacts, joint laws and loads follow from its text. No other file is opened; a
deck that needs others is judged by what its arrays must have in common alone (:mod:`mbla.results.coherence`), which
every file that is read must have.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import NoReturn

import numpy as np

from mbla import __version__
from mbla.contacts.glue import held_model
from mbla.deck import Deck, read_deck_text
from mbla.deck.reading import sha256_of
from mbla.errors import DeckError
from mbla.model import Model, build_model
from mbla.model.settlement import with_reference
from mbla.results.hdf5.case_content import Content, Value
from mbla.results.hdf5.content import content_of
from mbla.results.results import Results
from mbla.run_deck import contacts_of

FOLDER = Path("deck of a result file")
"""stands for the folder of the deck: nothing is looked for there but what the deck includes"""

SAME = 1e-9
"""Difference over the largest of its kind up to which two arrays are one: rounding of another machine."""

FOUND_BY_SOLVING = ("reference", "angle", "tangent", "upright")
"""of loads: what the deck does not give but the run finds"""


class _OtherFileError(Exception):
    """The deck needs a file beside it."""


def differences_from_deck(results: Results) -> tuple[tuple[str, ...], str]:
    """Where model, contacts and loads are not those of the deck in the file, in words; why it was not built again.

    The second is empty where it was.
    """
    deck = results.deck
    differences: list[str] = []
    if sha256_of([*(text for _, text in deck.sources), *deck.overrides]) != deck.sha256:
        differences.append("the hash of the deck is not that of its text")
    wrote = results.provenance.get("mbla", "")
    if wrote != __version__:
        return tuple(differences), f"it was written by mbla {wrote or 'of unknown version'}"
    if len(deck.sources) != 1:
        return tuple(differences), "the deck is made of several files"
    try:
        differences += _differences(results, *_built(results))
    except _OtherFileError:
        return tuple(differences), "the deck needs files beside it"
    except DeckError as error:
        differences.append(f"the deck in the file is not valid: {error.faults[0]}")
    return tuple(differences), ""


def _built(results: Results) -> tuple[Deck, Content]:
    """The deck in the file, and the content of a file of its model."""

    def refuse(path: object, name: str) -> NoReturn:
        raise _OtherFileError

    record = results.deck
    deck = read_deck_text(record.sources[0][1], FOLDER / Path(record.name).name, record.overrides, expected=False)
    deck = replace(deck, resolve_file=refuse)
    model = build_model(deck)
    contacts = contacts_of(deck, model)
    model = _with_references(held_model(model, contacts), results.model)
    return deck, content_of(replace(results, model=model, contacts=contacts, cases=()))


def _with_references(model: Model, of_file: Model) -> Model:
    """The model with the reactions from which supports give way as the file has them: no deck says them."""
    reactions = {case.name: case.settlement.reference for case in of_file.load_cases if case.settlement is not None}
    cases = tuple(
        with_reference(case, reactions[case.name]) if case.settlement is not None and case.name in reactions else case
        for case in model.load_cases
    )
    return replace(model, load_cases=cases)


def _differences(results: Results, deck: Deck, built: Content) -> list[str]:
    found = content_of(replace(results, cases=()))
    solved = {f"cases/{case.name}/{name}" for case in results.model.load_cases for name in FOUND_BY_SOLVING}
    for case in results.model.load_cases:
        if case.tilt is not None:  # its loads lead to the angle, which the verification checks
            solved |= {f"cases/{case.name}/{name}" for name in ("dead_load", "live_load")}
        solved |= {f"cases/{case.name}/{part}/{name}" for part in ("settlement", "tilt") for name in FOUND_BY_SOLVING}
    differing = [
        path
        for path in sorted(found.keys() | built.keys())
        if path not in solved and not (path in found and path in built and _same(found[path], built[path]))
    ]
    differences = [f"{path} is not what the deck in the file gives" for path in differing]
    for solution in (case.solution for case in results.cases):
        for name in ("flow_rule", "contact_model"):
            if getattr(solution, name) != getattr(deck.analysis, name):
                differences.append(f"{name} is {getattr(solution, name)}, the deck asks for another")
    return differences


def _same(one: Value, other: Value) -> bool:
    """Whether two entries are equal but for rounding."""
    first, second = np.asarray(one), np.asarray(other)
    if first.shape != second.shape:
        return False
    if first.dtype.kind != "f":
        return bool(np.array_equal(first, second))
    size = float(np.abs(second[np.isfinite(second)]).max(initial=0.0))
    return bool(np.allclose(first, second, rtol=0.0, atol=SAME * size, equal_nan=True))
