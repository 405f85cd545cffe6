"""The model of a result file against the deck in it: it is read and built once more, and must come out the same.

Residuals and bounds prove an answer for the arrays of a file. That these arrays are the structure that its deck
describes is shown by the deck: blocks, contacts, joint laws and loads, settings and remarks follow from its texts and
the meshes and tables that it names. All of them are in the file, so that no other is opened.
"""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.findings import contacts_of
from mbla.contacts.glue import held_model
from mbla.deck import Deck
from mbla.deck.deck import sha256_of
from mbla.errors import DeckError, FileError, Notice
from mbla.model import Model, build_model
from mbla.model.model import LoadCase, Tilt
from mbla.model.settlement import with_reference
from mbla.results.hdf5.content import Content, Value, content_of
from mbla.results.provenance import deck_of, settings_in_words
from mbla.results.results import Results
from mbla.results.run_record import as_expected, notices_of
from mbla.solution.settings import solver_settings
from mbla.solution.tilt_circle import chord

SAME, SAME_OF_LARGEST = 1e-9, 1e-12
"""Differences of entries, relative to them and to the largest of their kind, that are rounding of another machine."""

UNEXPECTED = "not-as-expected"
"""identifier of notices that a run has only where it was asked to compare with what its deck expects"""


def rebuilt(results: Results) -> tuple[Deck | None, tuple[str, ...]]:
    """The deck in a file, None where it cannot be built, and where the file is not what follows from it, in words."""
    record = results.deck
    differences = []
    if sha256_of([*(text for _, text in record.sources), *record.overrides]) != record.sha256:
        differences.append("the hash of the deck is not that of its text")
    if record.sources[0][0] != record.name:
        differences.append("the deck does not have the name of its text")
    deck, of_model = _read_again(results, expected=True)
    if of_model:  # a study leaves expectations out, and what only they use is told as not used
        without, others = _read_again(results, expected=False)
        deck, of_model = (without, others) if deck is None or not others else (deck, of_model)
    return deck, (*differences, *of_model)


def _read_again(results: Results, *, expected: bool) -> tuple[Deck | None, list[str]]:
    """The deck with or without its expectations, None where it is not valid, and what of its model differs."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        try:
            deck = deck_of(results.deck, folder, expected=expected)
            return deck, _differences(results, _content(deck, results, folder))
        except (DeckError, FileError) as error:
            why = error.faults[0] if isinstance(error, DeckError) else error
            return None, [f"the deck in the file is not valid: {str(why).replace(f'{folder}/', '')}"]


def _content(deck: Deck, results: Results, folder: Path) -> Content:
    """The content of a file of the deck's model, without what only solving finds."""
    model = build_model(deck)
    contacts = contacts_of(deck, model)
    model = _with_loads_found(held_model(model, contacts), results.model)
    built = replace(
        results,
        model=model,
        contacts=contacts,
        notices=notices_of(deck, model, contacts),
        settings=settings_in_words(deck, solver_settings(deck.analysis)) | _threads(results),
    )
    if deck.content.expected and any(notice.identifier == UNEXPECTED for notice in results.notices):
        built = as_expected(built, deck)
    stopped = () if results.complete else results.notices[-1:]  # what stopped a run is not the deck's to say
    notices = _placed_as(results.notices, (*built.notices, *stopped), folder)
    return content_of(replace(built, cases=(), notices=notices, exit_code=results.exit_code))


def _threads(results: Results) -> dict[str, str]:
    """Of a run, beside its settings: no deck says them."""
    return {name: words for name, words in results.settings.items() if name == "threads"}


def _placed_as(told: Sequence[Notice], notices: Sequence[Notice], folder: Path) -> tuple[Notice, ...]:
    """Notices that begin with a place in the deck, with the folder that the file has there."""
    placed = list(notices)
    for row, (notice, own) in enumerate(zip(notices, told, strict=False)):
        place = notice.message.removeprefix(f"{folder}/")
        if place != notice.message:
            placed[row] = replace(notice, message=own.message if own.message.endswith(place) else place)
    return tuple(placed)


def _with_loads_found(model: Model, of_file: Model) -> Model:
    """The model with what is found of its loads by solving, as the file has it: no deck says it.

    That is the reaction from which a support gives way, and the angle of a tilting table.
    """
    known = {case.name: case for case in of_file.load_cases}
    cases = tuple(_found(case, known[case.name]) if case.name in known else case for case in model.load_cases)
    return replace(model, load_cases=cases)


def _found(case: LoadCase, of_file: LoadCase) -> LoadCase:
    if case.settlement is not None and of_file.settlement is not None:
        return with_reference(case, of_file.settlement.reference)
    tilt, known = case.tilt, of_file.tilt
    if tilt is None or known is None:
        return case
    tilt = replace(tilt, angle=known.angle, tangent=known.tangent, upright=known.upright)
    if known.tangent or of_file.live_load.shape != tilt.across.shape:
        return replace(case, tilt=tilt)
    return replace(case, tilt=tilt, live_load=chord(tilt, _angle(tilt, of_file.live_load)))


def _angle(tilt: Tilt, live_load: FloatArray) -> float:
    """Angle in radians to which a live load leads from the level table, whether it is that of collapse or not."""
    size = max(float(np.abs(tilt.across).max(initial=0.0)), np.finfo(np.float64).tiny)
    columns = np.column_stack([tilt.across.ravel(), -tilt.turning.ravel()]) / size
    (across, lowered), *_ = np.linalg.lstsq(columns, live_load.ravel() / size)
    return float(np.arctan2(across, 1.0 - lowered))


def _differences(results: Results, built: Content) -> list[str]:
    found = content_of(replace(results, cases=()))
    return [
        f"{path} is not what the deck in the file gives"
        for path in sorted(found.keys() | built.keys())
        if not (path in found and path in built and same(found[path], built[path]))
    ]


def same(one: Value, other: Value) -> bool:
    """Whether two entries are equal but for rounding."""
    first, second = np.asarray(one), np.asarray(other)
    if first.shape != second.shape:
        return False
    if first.dtype.kind != "f":
        return bool(np.array_equal(first, second))
    size = float(np.abs(second[np.isfinite(second)]).max(initial=0.0))
    return bool(np.allclose(first, second, rtol=SAME, atol=SAME_OF_LARGEST * size, equal_nan=True))
