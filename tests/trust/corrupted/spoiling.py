"""Ways of spoiling a result file: bytes that are damaged, a form that is malformed, claims that are forged."""

from __future__ import annotations

import random
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from mbla.results.hdf5.layout import LINKS, VERSION
from tests.results.changed_files import changing
from tests.trust.corrupted.files import content_of, identical, original_content

Edit = Callable[[h5py.File, str, random.Random], None]


def datasets(path: Path) -> list[str]:
    """Paths of all datasets."""
    found: list[str] = []
    with h5py.File(path) as file:
        file.visititems(lambda name, item: found.append(name) if isinstance(item, h5py.Dataset) else None)
    return found


# --- damage of disks and copies -----------------------------------------------------------------------------------

PAGE = 4096


def _flipped(image: bytes, generator: random.Random) -> bytes:
    spoilt = bytearray(image)
    for _ in range(generator.choice([1, 1, 1, 2, 8, 64])):
        spoilt[generator.randrange(len(image))] ^= 1 << generator.randrange(8)
    return bytes(spoilt)


def _cut_off(image: bytes, generator: random.Random) -> bytes:
    return image[: generator.randrange(len(image))]


def _zeroed(image: bytes, generator: random.Random) -> bytes:
    page = generator.randrange(len(image) // PAGE) * PAGE
    return _over(image, page, bytes(min(PAGE, len(image) - page)))


def _overwritten(image: bytes, generator: random.Random) -> bytes:
    length = generator.choice([1, 8, 64, 512, PAGE])
    return _over(image, generator.randrange(len(image) - length), generator.randbytes(length))


def _moved(image: bytes, generator: random.Random) -> bytes:
    """A page in the place of another."""
    source, target = (generator.randrange(len(image) // PAGE) * PAGE for _ in range(2))
    return _over(image, target, image[source : source + PAGE][: len(image) - target])


def _longer(image: bytes, generator: random.Random) -> bytes:
    place, more = generator.randrange(len(image) + 1), generator.randbytes(generator.choice([1, 8, 512]))
    return image[:place] + more + image[place:]


def _shorter(image: bytes, generator: random.Random) -> bytes:
    place, length = generator.randrange(len(image) - 512), generator.choice([1, 8, 512])
    return image[:place] + image[place + length :]


def _over(image: bytes, place: int, stretch: bytes) -> bytes:
    return image[:place] + stretch + image[place + len(stretch) :]


DAMAGES: dict[str, Callable[[bytes, random.Random], bytes]] = {
    "bits flipped": _flipped,
    "cut off": _cut_off,
    "page zeroed": _zeroed,
    "stretch overwritten": _overwritten,
    "page moved": _moved,
    "bytes inserted": _longer,
    "bytes left out": _shorter,
}


def damaged(image: bytes, kind: str, generator: random.Random) -> bytes:
    """The file with damage of a kind; never as it was."""
    while (spoilt := DAMAGES[kind](image, generator)) == image:
        pass
    return spoilt


# --- malformed ----------------------------------------------------------------------------------------------------


def _put(file: h5py.File, name: str, value: Any) -> None:
    del file[name]
    file[name] = value


def _removed(file: h5py.File, name: str, generator: random.Random) -> None:
    del file[name]


def _renamed(file: h5py.File, name: str, generator: random.Random) -> None:
    file.move(name, name + "_")


def _reshaped(file: h5py.File, name: str, generator: random.Random) -> None:
    values = np.atleast_1d(file[name][()])
    shapes = [values[:-1], values[None], np.concatenate([values, values]), values.ravel()[:0]]
    _put(file, name, generator.choice(shapes))


def _retyped(file: h5py.File, name: str, generator: random.Random) -> None:
    shape = file[name].shape
    kinds = [np.float32, np.int8, np.uint64, np.complex128, np.bool_, "S3", h5py.ref_dtype, h5py.string_dtype()]
    file_type = generator.choice(kinds)
    del file[name]
    file.create_dataset(name, shape=shape, dtype=file_type)


def _compound(file: h5py.File, name: str, generator: random.Random) -> None:
    shape = file[name].shape
    _put(file, name, np.zeros(shape, dtype=[("a", "f8"), ("b", "i4")]))


def _not_finite(file: h5py.File, name: str, generator: random.Random) -> None:
    values = file[name][()]
    if values.dtype.kind != "f" or not values.size:
        return _removed(file, name, generator)
    values = np.array(values)
    values.reshape(-1)[generator.randrange(values.size)] = generator.choice([np.nan, np.inf, -np.inf])
    file[name][()] = values
    return None


def _group(file: h5py.File, name: str, generator: random.Random) -> None:
    del file[name]
    file.create_group(name)


def _circle(file: h5py.File, name: str, generator: random.Random) -> None:
    del file[name]
    file[name] = generator.choice([file["/"], h5py.SoftLink("/" + name), h5py.SoftLink("/" + name + "/" + name)])


def _soft(file: h5py.File, name: str, generator: random.Random) -> None:
    file.move(name, "elsewhere")
    file[name] = h5py.SoftLink("/elsewhere")


def _external(file: h5py.File, name: str, generator: random.Random) -> None:
    del file[name]
    file[name] = h5py.ExternalLink(generator.choice(["/dev/zero", "none.h5", "../x.h5", file.filename]), "/" + name)


def _outside(file: h5py.File, name: str, generator: random.Random) -> None:
    """The values stand in another file."""
    shape, kind = file[name].shape or (1,), file[name].dtype
    del file[name]
    if generator.random() < 0.5:
        size = int(np.prod(shape)) * kind.itemsize
        file.create_dataset(name, shape=shape, dtype=kind, external=[("/dev/zero", 0, max(size, 1))])
        return
    layout = h5py.VirtualLayout(shape=shape, dtype=kind)
    layout[...] = h5py.VirtualSource("none.h5", name, shape=shape, dtype=kind)
    file.create_virtual_dataset(name, layout)


def _huge(file: h5py.File, name: str, generator: random.Random) -> None:
    shape = tuple(generator.choice([2**31, 2**40, 10**7]) for _ in file[name].shape) or (2**40,)
    kind = file[name].dtype
    del file[name]
    while float(np.prod([float(size) for size in shape])) * kind.itemsize > 2.0**62:
        shape = (*shape[:-1], shape[-1] // 2**10 + 1)
    file.create_dataset(name, shape=shape, dtype=kind, chunks=tuple(1024 if i == 0 else 1 for i in range(len(shape))))


def _not_utf8(file: h5py.File, name: str, generator: random.Random) -> None:
    kind = h5py.string_dtype("utf-8", 8)
    bad = generator.choice([b"\xff\xfe\x80", b"a\xc3", b"\xed\xa0\x80", b"x\x00y"])
    _put(file, name, np.full(file[name].shape, bad, dtype="S8").astype(kind))


def _attribute(file: h5py.File, name: str, generator: random.Random) -> None:
    """A root attribute that is missing or of another type or value."""
    attribute = generator.choice(["filetype", "version", "mbla_version", "created", "deck_sha256", "complete"])
    del file.attrs[attribute]
    values = [None, b"\xff", np.arange(3), "4", 3.5, h5py.Empty("f8"), -1, 2**40, "mbla", np.zeros(0)]
    value = generator.choice(values)
    if value is not None:
        file.attrs[attribute] = value


def _version(file: h5py.File, name: str, generator: random.Random) -> None:
    file.attrs["version"] = generator.choice([0, 1, VERSION - 1, VERSION + 1, 99, -1, 2**62])


def _incomplete(file: h5py.File, name: str, generator: random.Random) -> None:
    if generator.random() < 0.5:
        del file.attrs["complete"]
    else:
        file.attrs["complete"] = 0


MALFORMED: dict[str, Edit] = {
    "dataset removed": _removed,
    "dataset renamed": _renamed,
    "dataset of another shape": _reshaped,
    "dataset of another type": _retyped,
    "dataset of a compound type": _compound,
    "number not finite": _not_finite,
    "group for a dataset": _group,
    "links in a circle": _circle,
    "soft link": _soft,
    "external link": _external,
    "values in another file": _outside,
    "huge shape": _huge,
    "text that is not UTF-8": _not_utf8,
    "root attribute": _attribute,
    "layout version": _version,
    "not complete": _incomplete,
}


def malform(path: Path, kind: str, generator: random.Random) -> str:
    """Malform a file in one place; which."""
    name = generator.choice(datasets(path))
    with changing(path) as file:
        MALFORMED[kind](file, name, generator)
    return name


# --- forged -------------------------------------------------------------------------------------------------------

WORDS = (
    *("solved", "approximate", "unbounded", "no_equilibrium", "not_verified"),
    *("yes", "only by self-stress", "doubtful", "associative", "non_associative", "dilatancy"),
    *("convex", "concave", "clarabel", "steel", ""),
)


def _changed(file: h5py.File, name: str, generator: random.Random) -> None:
    """One entry, or all: a share of itself between 1e-3 and 1e3 more or less, nothing, no number, another word."""
    values = np.array(file[name][()])
    flat = values.reshape(-1)
    places = slice(None) if generator.random() < 0.3 else slice(row := generator.randrange(max(len(flat), 1)), row + 1)
    if values.dtype.kind == "f":
        size = float(np.abs(flat[np.isfinite(flat)]).max(initial=0.0)) or 1.0
        share = generator.choice([-1, 1]) * 10.0 ** generator.uniform(-3, 3)
        choices = (flat[places] * (1.0 + share), flat[places] + share * size, 0.0, np.nan, np.inf, -flat[places])
        flat[places] = generator.choice(choices)
    elif values.dtype.kind == "u":
        flat[places] = 1 - np.minimum(flat[places], 1)
    elif values.dtype.kind == "i":
        flat[places] = generator.choice((flat[places] + 1, flat[places] - 1, 0, 10 * flat[places]))
    else:
        values = values.astype("S400")
        values.reshape(-1)[places] = generator.choice(WORDS).encode()
    _replace(file, name, values)


def _replace(file: h5py.File, name: str, values: Any) -> None:
    """Values in place of those of a dataset, whose attributes stay."""
    old = file[name]
    if values.dtype.kind == "S":
        kind = h5py.string_dtype("utf-8", max(2, *(len(text) for text in np.append(values.ravel(), b""))))
        attributes = {key: old.attrs[key] for key in old.attrs if key not in LINKS and key != "DIMENSION_LABELS"}
        del file[name]
        file.create_dataset(name, data=values.astype(kind))
        file[name].attrs.update(attributes)
    else:
        old[...] = values


def _left_out(file: h5py.File, name: str, generator: random.Random) -> None:
    """A dataset, or the whole group that it stands in."""
    group = name.rpartition("/")[0]
    del file[group if group.count("/") > 1 and generator.random() < 0.5 else name]


def _swapped(file: h5py.File, name: str, generator: random.Random) -> None:
    """The dataset with that of another load case."""
    place = name.split("/")
    others = ["/".join((place[0], other, *place[2:])) for other in file["cases"] if place[0] == "cases"]
    others = [other for other in others if other in file and other != name]
    if not others:
        return _changed(file, name, generator)
    other = generator.choice(others)
    file.move(name, "swapped")
    file.move(other, name)
    file.move("swapped", other)
    return None


def _other_attribute(file: h5py.File, name: str, generator: random.Random) -> None:
    """An attribute of the file, or of a dataset, changed or removed."""
    owner = file if generator.random() < 0.4 else file[name]
    key = generator.choice([key for key in owner.attrs if key not in (*LINKS, "CLASS", "NAME", "DIMENSION_LABELS")])
    if generator.random() < 0.3:
        del owner.attrs[key]
    else:
        owner.attrs[key] = generator.choice([b"MN", b"forged", 0, 1, 7])


FORGERIES: tuple[Edit, ...] = (_changed, _changed, _changed, _left_out, _swapped, _other_attribute)


def forge(original: Path, path: Path, generator: random.Random) -> str:
    """Forge a file in one thing; what was done, in words."""
    said = ""
    while not said or identical(original_content(original), content_of(path)):
        shutil.copy(original, path)
        found = datasets(path)
        of_cases = [name for name in found if name.startswith("cases/")]
        name = generator.choice(of_cases if generator.random() < 0.7 else found)
        kind = generator.choice(FORGERIES)
        with changing(path) as file:
            kind(file, name, generator)
        said = f"{kind.__name__.removeprefix('_')} {name}"
    return said
