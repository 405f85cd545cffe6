"""The contract of readers of geometry files, and what several of them need: remarks on leftovers, JSON, names."""

from __future__ import annotations

import json
import re
import unicodedata
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np

from mbla.arrays import IntArray
from mbla.deck.suggestions import listed
from mbla.errors import Notice, Refusal
from mbla.model.solids.polyhedra import Polyhedra
from mbla.model.wording import counted, with_count

LONGEST_REASON = 500
"""characters of the reason why a file is refused, some of which comes from libraries, or the file itself"""


class GeometryFileError(Refusal):
    """The file cannot be read, or holds no blocks; the message is for the user of the deck."""


def malformed(kind: str, reason: str) -> GeometryFileError:
    """What a file is refused by that is not what its extension says."""
    return GeometryFileError("geometry-file", f"is not a well-formed {kind} file: {reason}")


@contextmanager
def well_formed(kind: str) -> Iterator[None]:
    """Raises GeometryFileError for a document of JSON in which something is missing, or other than its format says."""
    try:
        yield
    except RecursionError:
        raise malformed(kind, "its JSON is nested too deeply") from None
    except (LookupError, TypeError, ValueError, AttributeError, OverflowError) as error:
        raise malformed(kind, f"lacks {error}" if isinstance(error, KeyError) else str(error)) from error


@dataclass(frozen=True)
class Geometry:
    """Content of a file in its own coordinates and order, faces in any orientation.

    polyhedra : what the file keeps apart: its objects, each one or several closed surfaces; or its volume cells
    notices   : what was left out or put right
    names     : name of each polyhedron in the file, empty where it has none; or no entry at all
    sets      : (n,) number of the set of each volume cell, beside its name; None where the file has no such numbers
    cells     : each polyhedron is a volume cell, and so a block; else surfaces, whose closed parts are the blocks
    indexed   : faces share vertices by number, so that two vertices at one place are worth a remark
    unit      : unit of length of the file, where its header says so
    planar    : outlines of a drawing in x and z, each extended from y = 0 to y = 1; the deck gives the thickness
    """

    polyhedra: Polyhedra
    notices: tuple[Notice, ...] = ()
    names: tuple[str, ...] = ()
    sets: IntArray | None = None
    cells: bool = False
    indexed: bool = True
    unit: str | None = None
    planar: bool = False


def parse_json(content: bytes) -> Any:
    """The document; of a key that an object has twice neither value is taken.

    Raises
    ------
    ValueError
        for text that is no JSON in UTF-8, and for keys that are there twice
    RecursionError
        for text that is nested too deeply
    """
    return json.loads(content.decode("utf-8-sig"), object_pairs_hook=_without_twins)


def _without_twins(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    entries = dict(pairs)
    if len(entries) < len(pairs):
        keys = [key for key, _ in pairs]
        twice = next(key for key in keys if keys.count(key) > 1)
        raise ValueError(f"an object has the key {twice[:40]!r} twice")
    return entries


def empty_objects(names: Sequence[str]) -> tuple[Notice, ...]:
    """A warning of objects without faces, by their names; nothing where there are none."""
    if not names:
        return ()
    called = listed([name or "without a name" for name in names], "and")
    return (Notice("warning", "objects-empty", with_count(len(names), "object", f"left out, without faces: {called}")),)


def cells_left_out(kinds: Iterable[str], beside_volumes: bool) -> tuple[Notice, ...]:
    """What becomes no block, in words, from the type of each; nothing where there is none."""
    counts = Counter(kinds)
    if not counts:
        return ()
    words = ", ".join(f"{count} of type {kind}" for kind, count in counts.items())
    reason = "in files with volume cells only these become blocks" if beside_volumes else "these cells are not blocks"
    return (Notice("notice", "mesh-cells-left-out", f"cells were left out: {words}; {reason}"),)


def check_rows(rows: IntArray, count: int) -> None:
    """Raises GeometryFileError where a cell names a point, by its row, that does not exist."""
    wrong = rows[(rows < 0) | (rows >= count)]
    if wrong.size:
        words = f"a cell names point {wrong.flat[0]}, which does not exist; there are {count}, from 0 on"
        raise GeometryFileError("geometry-file", words)


def unused_points(count: int, used: IntArray) -> tuple[Notice, ...]:
    """A warning of points of a file that nothing in it uses; nothing where there are none.

    count : number of points of the file
    used  : (n,) rows of points that faces, cells or elements name, in any order
    """
    unused = count - len(np.unique(used))
    if unused <= 0:
        return ()
    words = f"{unused} of the {counted(count, 'vertex')} of the file used by no face: is it complete?"
    return (Notice("warning", "file-vertices-unused", words),)


LONGEST = 64


def member_name(text: str) -> str:
    """A name with letters, digits and ``. _ -`` only; empty for an empty one.

    >>> member_name("Gewölbe 1"), member_name("Mesh1 Group1 Model"), member_name(".x")
    ('Gewolbe_1', 'Mesh1_Group1_Model', '_.x')
    """
    # letters with marks become plain ones; those of other alphabets go
    plain = unicodedata.normalize("NFKD", text.strip()).encode("ascii", "ignore").decode("ascii")
    name = re.sub(r"[^A-Za-z0-9_.-]+", "_", plain)
    if not name and text.strip():
        name = "_"
    return ("_" + name if name[:1] in (".", "-") else name)[:LONGEST]
