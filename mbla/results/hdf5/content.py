"""Results as the flat content of a result file: path -> array, text or number, as their quantities give it."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from mbla import __version__
from mbla.results.hdf5.layout import FILETYPE, VERSION, Content, fields_of
from mbla.results.quantities.quantity import UNVERIFIED, Quantity
from mbla.results.quantities.registry import OF_CASES, OF_MODEL, OF_RUN
from mbla.results.record.scene import AskedScene, Scene, scene_of
from mbla.results.results import Results


def root_attributes(results: Results) -> dict[str, str | int]:
    """Attributes of the root group."""
    return {
        "filetype": FILETYPE,
        "version": VERSION,
        "mbla_version": results.provenance.get("mbla", __version__),
        "created": results.created,
        "deck_sha256": results.deck.sha256,
        "complete": int(results.complete),
    }


def content_of(results: Results) -> Content:
    """Everything in the results by its path in the file."""
    assembly = results.assembly
    content = _stored(OF_RUN, results) | _stored(OF_MODEL, Scene(assembly, None))
    for load_case in results.model.load_cases:
        content |= _stored(ASKED, AskedScene(assembly, None, load_case), load_case.name)
    for case in results.cases:
        content |= _stored(FOUND, scene_of(results, case), case.load_case.name)
    return content


ASKED = tuple(quantity for quantity in OF_CASES if quantity.asked)
"""of every load case"""
FOUND = tuple(quantity for quantity in OF_CASES if not quantity.asked)
"""of those that were solved"""


def _stored(quantities: Iterable[Quantity], owner: Results | Scene, case: str = "") -> Content:
    """Values of quantities by their paths, those that there are."""
    values = {quantity.path.replace("*", case): quantity.stored(owner) for quantity in quantities}
    return {path: value for path, value in values.items() if value is not None}


def unverified_kinds(results: Results) -> tuple[str, ...]:
    """Kinds of statements in the results that the run alone can make, so that they cannot be verified."""
    content = content_of(results)
    placed = fields_of([case.name for case in results.model.load_cases])
    found = {
        each.unproved(content[path]) for path, each in placed if path in content and np.size(np.asarray(content[path]))
    }
    return tuple(kind for kind in UNVERIFIED.values() if kind in found)
