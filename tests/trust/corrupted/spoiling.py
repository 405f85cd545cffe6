"""Ways of spoiling a result file: bytes that are damaged, claims that are forged."""

from __future__ import annotations

import random
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from mbla.results.hdf5.layout import LINKS
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
