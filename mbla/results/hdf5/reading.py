"""What an open result file holds: results, or datasets as they stand there."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from mbla.assembly.assembly import Assembly
from mbla.errors import FileError
from mbla.results.hdf5.content import ASKED, FOUND
from mbla.results.hdf5.layout import (
    ATTRIBUTES,
    FILETYPE,
    SHARED_DIMENSIONS,
    VERSION,
    Content,
    check_indices,
    placed,
    read_field,
    strings,
    text_of,
)
from mbla.results.hdf5.restore import LOADS_FOUND, SOIL_FOUND, built_again, deck_record, results_from, with_loads_found
from mbla.results.provenance import has_its_hash
from mbla.results.quantities.quantity import Quantity
from mbla.results.quantities.registry import OF_MODEL, OF_RUN
from mbla.results.results import Results

if TYPE_CHECKING:
    import h5py

LARGEST_RATIO = 2000
"""an array cannot be larger than this many times its file: gzip reaches about 1000"""

DAMAGE = (KeyError, RuntimeError, ValueError, TypeError, IndexError, AttributeError, OverflowError, MemoryError)
"""what reading a damaged file may end with"""


def in_one_line(error: BaseException) -> str:
    """The first line of an error in words, of HDF5 the cause alone; a KeyError puts its text in quotes."""
    text = str(error.args[0]) if isinstance(error, KeyError) and error.args else str(error)
    line = text.splitlines()[0] if text else type(error).__name__
    cause = re.fullmatch(r"(?:Unable to|Can't) [a-z ]+\((.+)\)", line)
    return cause[1] if cause else line


def _read_attributes(file: h5py.File, path: Path) -> dict[str, str | int]:
    """Root attributes; what the file is and its version come first."""
    if "filetype" not in file.attrs or text_of(file.attrs["filetype"]) != FILETYPE:
        raise FileError("damaged-result-file", f"{path}: not an mbla result file")
    version = int(file.attrs["version"])
    if version != VERSION:
        wrote = text_of(file.attrs.get("mbla_version", "of unknown version"))
        remedy = "run the deck again; its text is in /deck/source_texts" if version < VERSION else "use a newer mbla"
        raise FileError(
            "old-result-file",
            f"{path}: layout version {version}, written by mbla {wrote}; this mbla reads version {VERSION}: {remedy}",
        )
    return {
        name: int(file.attrs[name]) if name in ("version", "complete") else text_of(file.attrs[name])
        for name in ATTRIBUTES
    }


SAME_PLACE = 1e-6
"""distance of centroids and contact points, over the farthest from the origin, up to which they are one"""


def results_of(file: h5py.File, path: Path, *, to_verify: bool = False) -> Results:
    """Results of an open file: model and contacts from the deck in it, all else from its arrays.

    to_verify : the deck may have been changed, and centroids and contact points be others than its own: a verification
                says so
    """
    attributes, file_bytes = _read_attributes(file, path), path.stat().st_size
    sizes: dict[str, int] = {"axis": 3, "direction": 3, "component": 6, "pair": 2, "unit": 3}
    run = _read_content(file, file_bytes, [(each.path, each) for each in OF_RUN], sizes)
    record = deck_record(run, attributes)
    if not to_verify and not has_its_hash(record):
        words = "its deck was changed after the run: run the deck again, mbla verify says what differs"
        raise FileError("damaged-result-file", f"{path}: {words}")
    soil = _read_content(file, file_bytes, [(each.path, each) for each in SOIL_FOUND], sizes.copy())
    assembly = built_again(record, path, soil)
    sizes |= sizes_of(assembly)
    for name in (name for name in sizes if name in SHARED_DIMENSIONS and name in file):
        if len(file[name]) != sizes[name]:
            words = f"its arrays are not of what its deck gives: {len(file[name])} along {name}, not {sizes[name]}"
            raise FileError("damaged-result-file", f"{path}: {words}")
    if not to_verify:
        _refuse_other_geometry(file, path, assembly)
    cases = [case.name for case in assembly.model.load_cases]
    loads = _read_content(file, file_bytes, placed(LOADS_FOUND, cases), sizes)
    found = _read_content(file, file_bytes, placed(FOUND, cases), sizes)
    return results_from(run | found, attributes, record, with_loads_found(assembly, loads))


def _refuse_other_geometry(file: h5py.File, path: Path, assembly: Assembly) -> None:
    """FileError where blocks or contact points of the deck are not those that the forces in the file act on."""
    geometry = {"model/centroids": assembly.model.blocks.centroids, "contacts/points": assembly.contacts.points}
    for name, built in geometry.items():
        stored = _dataset(file, name, path.stat().st_size)[()]
        apart = stored.shape != built.shape or np.abs(stored - built).max(initial=0.0)
        if not apart <= SAME_PLACE * np.abs(built).max(initial=0.0):
            words = f"{name} are not those that its deck gives: run the deck again, mbla verify says what differs"
            raise FileError("damaged-result-file", f"{path}: {words}")


def sizes_of(assembly: Assembly) -> dict[str, int]:
    """Sizes of the dimensions that are along the arrays of results."""
    model, contacts = assembly.model, assembly.contacts
    blocks, points = len(model.blocks), len(contacts.points)
    return {"block": blocks, "interface": len(contacts), "point": points, "tie": len(model.ties)}


def _read_content(
    file: h5py.File, file_bytes: int, fields: Sequence[tuple[str, Quantity]], sizes: dict[str, int]
) -> Content:
    content: Content = {}
    parts: dict[str, set[bool]] = {}
    for path, field in fields:
        present = path in file
        if field.part and not field.asked:
            parts.setdefault(f"{path.split('/')[1]}: {field.part}", set()).add(present)
        elif not present and not field.part:
            raise ValueError(f"{path} is missing")
        if present:
            content[path] = read_field(_dataset(file, path, file_bytes), path, field, sizes)
    incomplete = [part for part, presence in parts.items() if len(presence) > 1]
    if incomplete:
        raise ValueError(f"incomplete: {', '.join(incomplete)}")
    for path, field in fields:
        if path in content:
            check_indices(path, field, content[path], sizes)
    return content


def asked_of(file: h5py.File, path: Path, cases: Iterable[str]) -> Content:
    """What a file holds of run, model, contacts and loads, as it stands there; of damaged datasets their fault."""
    content: Content = {}
    for name, field in [(each.path, each) for each in (*OF_RUN, *OF_MODEL)] + placed(ASKED, cases):
        if name not in file:
            continue
        try:
            dataset = _dataset(file, name, path.stat().st_size)
            texts = strings(dataset) if field.kind == "text" else []
            content[name] = (texts if field.dims else texts[0]) if texts else dataset[()]
        except (OSError, *DAMAGE) as error:
            content[name] = in_one_line(error)
    return content


def _dataset(file: h5py.File, path: str, file_bytes: int) -> h5py.Dataset:
    dataset = file[path]
    if not hasattr(dataset, "shape"):
        raise ValueError(f"{path} is not a dataset")
    if dataset.file != file or dataset.external or dataset.is_virtual:
        raise ValueError(f"{path} stands in another file")
    if dataset.nbytes > LARGEST_RATIO * file_bytes:
        raise ValueError(f"{path} claims {dataset.nbytes} bytes")
    return dataset
