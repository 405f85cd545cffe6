"""The HDF5 result file: written as one image in memory, read back in full (only importer of h5py).

The file is built in memory because a process that is killed, or a disk that fills up, while HDF5 writes leaves a file
that nothing can read. Large arrays are chunked with gzip and shuffle; small ones and single values are stored inside
object headers, which carry checksums from HDF5 1.10 on. So a file that was damaged is found out instead of giving other
numbers: gzip has a checksum of its own. What was changed on purpose, ``mbla verify`` finds.
"""

from __future__ import annotations

import io
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mbla.deck.units import Units
from mbla.errors import FileError
from mbla.results.hdf5.content import content_of, root_attributes
from mbla.results.hdf5.layout import (
    SHARED_DIMENSIONS,
    Content,
    Value,
    differences,
    fields_of,
    text_of,
)
from mbla.results.hdf5.reading import DAMAGE, asked_of, in_one_line, results_of
from mbla.results.hdf5.stored_record import KINDS, StoredRecord
from mbla.results.quantities.quantity import NOT_VERIFIED, Quantity, unit_text
from mbla.results.record.scene import as_text
from mbla.results.results import Results

if TYPE_CHECKING:
    import h5py

CHUNK_BYTES = 1 << 20
COMPACT_BYTES, COMPACT_VALUE_BYTES = 1024, 60_000
"""arrays and single values up to these sizes stand in the object header, which holds at most 64 KiB"""


@dataclass(frozen=True)
class Labelled:
    """An array of a labelled file; text as objects.

    dimensions : paths of scales, one for each dimension
    attributes : ``units``, ``long_name`` and others
    missing    : the value of integers that stands for none; None where there is no such
    """

    values: np.typing.NDArray[Any]
    dimensions: tuple[str, ...]
    attributes: Mapping[str, str]
    missing: int | None = None


@dataclass(frozen=True)
class LabelledFile:
    """Arrays and scales by path; the scale of a dimension says what is along it."""

    attributes: Mapping[str, str | int]
    scales: Mapping[str, Labelled]
    arrays: Mapping[str, Labelled]


def write_results_hdf5(results: Results) -> bytes:
    """The result file as bytes; the same results give the same bytes.

    Layout: schemas/results.md. It cannot fail for want of disk space; the caller writes the bytes.
    Raises AssertionError for content that the layout does not have.
    """
    content, units = content_of(results), results.model.units
    scales: dict[str, Labelled] = {}
    arrays = {
        path: _labelled(scales, path, field, content.pop(path), units)
        for path, field in fields_of(case.name for case in results.model.load_cases)
        if path in content
    }
    if content:
        raise AssertionError(f"not in the layout: {sorted(content)}")
    return write_labelled_hdf5(LabelledFile(root_attributes(results), scales, arrays))


@contextmanager
def _image() -> Iterator[tuple[io.BytesIO, h5py.File]]:
    """A new file in memory, complete when the block is left.

    HDF5's own image of a file, which its core driver gives, cannot be opened by releases before 2.0: the check sum of
    its first block is not that of its bytes.
    """
    import h5py

    image = io.BytesIO()
    with h5py.File(image, "w", libver=("v110", "v110")) as file:
        yield image, file


def read_results_hdf5(path: Path, *, to_verify: bool = False) -> Results:
    """Results from a file: its deck builds model and contacts again, its arrays are what was found.

    to_verify : its deck may have been changed, and blocks and contact points be elsewhere: a verification says so

    Raises FileError where the file cannot be read, is not an mbla result, has another layout version or is damaged,
    and where its deck was changed or its arrays are not of what that gives.
    """
    import h5py

    _try_opening(path)
    try:
        with h5py.File(path, "r", locking=False) as file:
            return results_of(file, path, to_verify=to_verify)
    except FileError:
        raise
    except OSError as error:
        what = "not an HDF5 file" if "signature not found" in str(error) else f"damaged: {in_one_line(error)}"
        raise FileError("damaged-result-file", f"{path}: {what}") from error
    except DAMAGE as error:
        raise FileError("damaged-result-file", f"{path}: damaged: {in_one_line(error)}") from error


CHECKPOINT = "mbla checkpoint"
"""filetype of what a run can go on from"""


def write_checkpoint_hdf5(record: StoredRecord, about: Mapping[str, str]) -> bytes:
    """A record that a run can go on from, as a file.

    about : deck, program and load case, as attributes
    """
    with _image() as (image, file):
        file.attrs.update({"filetype": CHECKPOINT, **about})
        file["tree"] = np.frombuffer(record.tree.encode("utf-8"), dtype=np.uint8)
        for kind, values in record.arrays.items():
            packed = {"compression": "gzip", "shuffle": True} if len(values) else {}
            file.create_dataset(kind, data=values, **packed)
    return image.getvalue()


def read_checkpoint_hdf5(path: Path) -> tuple[StoredRecord, dict[str, str]]:
    """The record in such a file with its attributes; FileError where it is no such file, or damaged."""
    import h5py

    _try_opening(path)
    try:
        with h5py.File(path, "r", locking=False) as file:
            about = {name: text_of(value) for name, value in file.attrs.items()}
            if about.get("filetype") != CHECKPOINT:
                raise FileError("damaged-result-file", f"{path}: is not what a run can go on from")
            tree, arrays = file["tree"][()].tobytes().decode("utf-8"), {kind: file[kind][()] for kind in KINDS}
            return StoredRecord(tree, arrays), about
    except FileError:
        raise
    except (OSError, *DAMAGE) as error:
        raise FileError("damaged-result-file", f"{path}: damaged: {in_one_line(error)}") from error


def read_asked(path: Path, cases: Iterable[str]) -> Content:
    """What a file holds of run, model, contacts and loads, as it stands there; of damaged datasets their fault.

    Raises FileError where the file is damaged.
    """
    import h5py

    try:
        with h5py.File(path, "r", locking=False) as file:
            return asked_of(file, path, cases)
    except (OSError, *DAMAGE) as error:
        raise FileError("damaged-result-file", f"{path}: damaged: {in_one_line(error)}") from error


def differences_of_file(path: Path, image: bytes) -> tuple[str, ...]:
    """Where a file is not the one of these bytes, which ``write_results_hdf5`` gave, in words."""
    import h5py

    try:
        if path.read_bytes() == image:  # on the machine that wrote it
            return ()
        with h5py.File(path, "r", locking=False) as found, h5py.File(io.BytesIO(image), "r") as wanted:
            return tuple(differences(found, wanted))
    except (OSError, *DAMAGE) as error:
        return (f"it cannot be compared with what was recomputed: {in_one_line(error)}",)


def _try_opening(path: Path) -> None:
    """What the operating system refuses, in its own words: those of HDF5 are long and name addresses in memory."""
    try:
        if path.is_dir():
            raise FileError("folder-given", f"{path}: is a folder, not a result file")
        if path.exists() and not path.is_file():  # opening a pipe would wait without end
            raise FileError("not-a-regular-file", f"{path}: is not a regular file")
        path.open("rb").close()
    except OSError as error:
        raise FileError("file-unreadable", f"{path}: {error.strerror or error}") from error


def write_labelled_hdf5(content: LabelledFile) -> bytes:
    """An HDF5 file of labelled arrays as bytes, as netCDF-4 has them; the same content gives the same bytes."""
    from h5py import h5ds

    with _image() as (image, file):
        for name, value in content.attributes.items():
            _set_attribute(file.id, name, value)
        scales = {path: _create_labelled(file, path, scale) for path, scale in content.scales.items()}
        for path, scale in scales.items():
            h5ds.set_scale(scale, path.rpartition("/")[2].encode())
        for path, array in content.arrays.items():
            dataset = _create_labelled(file, path, array)
            for axis, dimension in enumerate(array.dimensions):
                h5ds.set_label(dataset, axis, dimension.rpartition("/")[2].encode())
                h5ds.attach_scale(dataset, scales[dimension], axis)
    return image.getvalue()


def _create_labelled(file: h5py.File, name: str, content: Labelled) -> h5py.h5d.DatasetID:
    values, text = content.values, content.values.dtype.kind == "O"
    if text:
        values = np.reshape(_text_array([str(value) for value in values.ravel()]), values.shape)
    dataset = _create(file, name, np.asarray(values, order="C"))
    for attribute, value in content.attributes.items():
        _set_attribute(dataset, attribute, value)
    if text:
        _set_attribute(dataset, "_Encoding", "utf-8")  # netCDF's word for it: xarray gives text, not bytes
    if content.missing is not None:
        _set_attribute(dataset, "_FillValue", np.array([content.missing], dtype=values.dtype))
    return dataset


# --- writing ------------------------------------------------------------------------------------------------------


def _set_attribute(owner: h5py.h5g.GroupID, name: str, value: str | int | np.typing.NDArray[Any]) -> None:
    """An attribute inside the object header; text at its own length, as text of variable length stands outside.

    By the functions beneath ``attrs`` of h5py, which looks for one of that name first: there is none.
    """
    import h5py

    array = _text_array(value) if isinstance(value, str) else np.asarray(value)
    kind, space = h5py.h5t.py_create(array.dtype, logical=True), h5py.h5s.create_simple(array.shape)
    h5py.h5a.create(owner, name.encode(), kind, space).write(array, mtype=h5py.h5t.py_create(array.dtype))


def _text_array(value: str | Sequence[str]) -> np.typing.NDArray[Any]:
    """UTF-8 text of fixed length as h5py wants it; at least 2 bytes, as netCDF joins arrays of single letters."""
    import h5py

    encoded = [text.encode("utf-8", "backslashreplace") for text in ([value] if isinstance(value, str) else value)]
    kind = h5py.string_dtype("utf-8", max([2, *map(len, encoded)]))
    array = np.array(encoded, dtype=kind)
    return array.reshape(()) if isinstance(value, str) else array


def _labelled(scales: dict[str, Labelled], path: str, field: Quantity, value: Value, units: Units) -> Labelled:
    """An entry as the layout has it; scales that it needs are added to those of the file so far, by their paths."""
    if field.kind == "text":
        array = as_text([value] if isinstance(value, str) else value)  # type: ignore[arg-type]
        array = array if field.dims else array.reshape(())
    else:
        kinds = {"float": np.float64, "int": np.int64, "bool": np.uint8, "byte": np.uint8}
        array = np.array(value, kinds[field.kind])
    if array.ndim != len(field.dims):
        raise AssertionError(f"{field.path}: {array.ndim} dimensions, the layout has {len(field.dims)}")
    attributes = {"units": unit_text(field.unit, units), "long_name": field.words}
    if kind := field.unproved(value):
        attributes["verification"] = NOT_VERIFIED.format(kind)
    sizes = zip(field.dims, array.shape, strict=True)
    return Labelled(array, tuple(_scale(scales, path, name, size) for name, size in sizes), attributes)


def _scale(scales: dict[str, Labelled], path: str, name: str, size: int) -> str:
    """Path of the dimension scale of that name: in the root group if it is shared, else next to the dataset."""
    place = name if name in SHARED_DIMENSIONS else f"{path.rpartition('/')[0]}/{name}"
    words = {"units": "1", "long_name": f"dimension: {name.replace('_', ' ')}"}
    known = scales.setdefault(place, Labelled(np.arange(size, dtype=np.int64), (place,), words))
    if len(known.values) != size:
        raise AssertionError(f"{path}: {size} along {name}, which has {len(known.values)}")
    return place


def _create(file: h5py.File, path: str, array: np.typing.NDArray[Any]) -> h5py.h5d.DatasetID:
    """By the functions beneath ``create_dataset`` of h5py, which take half of its time for the many small arrays."""
    from h5py import h5d, h5p, h5s, h5t

    properties = h5p.create(h5p.DATASET_CREATE)
    properties.set_obj_track_times(False)
    if 0 < array.nbytes <= (COMPACT_BYTES if array.ndim else COMPACT_VALUE_BYTES):
        properties.set_layout(h5d.COMPACT)
    elif array.size and array.ndim:
        row_bytes = max(1, array.nbytes // len(array))
        properties.set_chunk((max(1, min(len(array), CHUNK_BYTES // row_bytes)), *array.shape[1:]))
        properties.set_shuffle()
        properties.set_deflate(4)
    links = h5p.create(h5p.LINK_CREATE)
    links.set_create_intermediate_group(True)
    space = h5s.create_simple(array.shape) if array.ndim else h5s.create(h5s.SCALAR)
    dataset = h5d.create(file.id, path.encode(), h5t.py_create(array.dtype, logical=True), space, properties, links)
    dataset.write(h5s.ALL, h5s.ALL, array, h5t.py_create(array.dtype))
    return dataset
