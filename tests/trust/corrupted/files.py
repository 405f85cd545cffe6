"""The result files that are spoilt, with every kind of answer and proof between them, and what they claim."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from mbla.process.run_options import RunOptions
from mbla.results.hdf5.layout import AGREEMENT, LINKS
from mbla.results.quantities.registry import STORED
from mbla.run import run
from tests.decks.folder import BENCHMARKS

SEVERAL = {
    "several.yaml": """\
mbla: 1
include: [parts/dry.yaml]
materials: {stone: {density: 2000}}
blocks: [{mesh: {group: block, material: stone, file: parts/block.obj, up: z, units: m}}]
contacts: {joint: dry}
supports: [{ground: {z: 0}}]
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}, back: {live: [{acceleration: [-1, 0, 0.2]}]}}
""",
    "parts/dry.yaml": "mbla: 1\njoints: {dry: {friction: 0.3}}\n",
    "parts/block.obj": """\
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 2.5
v 1 0 2.5
v 1 1 2.5
v 0 1 2.5
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
""",
}
"""a deck with an included file and a mesh"""
FORGED: dict[str, tuple[str, ...]] = {
    "wall_5x5": (),
    "ferris_wall_1": (),
    "plank_in_clamp": (),
    "tilting_block_cohesion": (),
    "beam_on_three_supports": (),
    "torque_convex": (),
    "eccentric_compression_convex": (),
    "beam_under_travelling_load": ("load_cases.crane.live.0.travel.positions=4",),
    "bar_between_walls": (),
    "incline_too_steep": (),
    "groove_locked": (),
    "glued_lintel": (),
    "several": (),
}
"""decks and what is changed in them: every flow rule and contact model, and every kind of proof, between them"""

SCALES = {(f"{field.path.rpartition('/')[0]}/{name}", field.unverified) for field in STORED for name in field.dims}
TOLD = {field.path for field in STORED if field.unverified} | {path for path, told in SCALES if told}
TOLD -= {path for path, told in SCALES if not told}
"""datasets that say that they are not verified, and scales that none but these have"""
PROVED = {(field.path, text.encode()) for field in STORED for text in field.proved}
"""values of these that are verified all the same"""
PROOFS = {
    *("lock", "level/lock", "standing/contact_forces", "standing/settlement"),
    *("certificate", "certificate_torsion_motions", "certificate_crushing_motions"),
}
"""datasets below a case that prove a claim and are none: others may prove the same"""
TOLD_ATTRIBUTES = ("mbla_version", "created")


def write_decks(folder: Path, names: tuple[str, ...] = tuple(FORGED)) -> dict[str, Path]:
    """Decks run in a folder: path of each result file by the name of its deck."""
    for name, text in SEVERAL.items():
        path = folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")
    for name in names:
        deck = folder / "several.yaml" if name == "several" else BENCHMARKS[name]
        run(deck, RunOptions(folder=folder / name, overrides=FORGED[name], force=True))
    return {name: folder / name / f"{name}.h5" for name in names}


Content = dict[tuple[str, str], Any]
"""values by the path of their dataset and the name of an attribute, which is empty for the dataset itself"""


@cache
def original_content(path: Path) -> Content:
    """Everything in a file that nobody changes."""
    return content_of(path)


def content_of(path: Path) -> Content:
    """Everything in a file but where its parts stand."""
    found: Content = {}

    def add(name: str, item: Any) -> None:
        if isinstance(item, h5py.Dataset):
            found[name, ""] = item[()]
        found.update({(name, key): value for key, value in item.attrs.items() if key not in LINKS})

    with h5py.File(path) as file:
        add("", file)
        file.visititems(add)
    return found


def claims_changed(one: Content, other: Content) -> list[str]:
    """Paths of datasets and attributes that differ, without those that are not verified, and by more than tolerance."""
    return sorted(
        "@".join(key).removesuffix("@")
        for key in one.keys() | other.keys()
        if not _is_told(*key, one, other) and not (key in one and key in other and _same(one[key], other[key]))
    )


def is_proof(claim: str, forged: Content) -> bool:
    """Whether what was changed is another proof of a claim that stayed.

    So it is where the associative answer of a case by associative flow was left out: by the layout the case's own
    forces and mechanism are that answer then, and the bounds of the file must follow from them.
    """
    if not claim.startswith("cases/"):
        return False
    _, case, name = claim.split("/", 2)
    group = f"cases/{case}/associative/"
    own = forged.get((f"cases/{case}/flow_rule", "")) == b"associative"
    left_out = own and not any(path.startswith(group) for path, _ in forged)
    return name in PROOFS or (left_out and claim.startswith(group))


def _is_told(path: str, attribute: str, one: Content, other: Content) -> bool:
    """Whether it is not verified; attributes are, but go with their dataset."""
    if not path:
        return attribute in TOLD_ATTRIBUTES
    first, _, rest = path.partition("/")
    field = f"cases/*/{rest.partition('/')[2]}" if first == "cases" else path
    value = other.get((path, ""), one.get((path, "")))
    told = field in TOLD and not (isinstance(value, bytes) and (field, value) in PROVED)
    return told and (not attribute or not ((path, "") in one and (path, "") in other))


def _same(one: Any, other: Any) -> bool:
    first, second = np.asarray(one), np.asarray(other)
    if first.shape != second.shape:
        return False
    if first.dtype.kind != "f" or second.dtype.kind != "f":
        return bool(np.array_equal(first, second))
    size = max(1.0 if not first.ndim else 0.0, float(np.abs(second[np.isfinite(second)]).max(initial=0.0)))
    return bool(np.allclose(first, second, rtol=0.0, atol=2.0 * AGREEMENT * size, equal_nan=True))


def identical(one: Content, other: Content) -> bool:
    """Whether two files hold the same to the last bit."""
    return one.keys() == other.keys() and all(_equal(one[key], other[key]) for key in one)


def _equal(one: Any, other: Any) -> bool:
    first, second = np.asarray(one), np.asarray(other)
    numbers = first.dtype.kind == "f" and second.dtype.kind == "f"
    return bool(np.array_equal(first, second, equal_nan=numbers))
