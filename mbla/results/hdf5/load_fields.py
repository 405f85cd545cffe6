"""Datasets of a result file that say what acts in a load case; ``*`` stands for its name."""

from __future__ import annotations

from mbla.results.hdf5.field import Field, FieldKind, UnitKind
from mbla.results.hdf5.mechanism_fields import CASE

RECORD_NAMES = {
    "travel/load_points": "travel/points",
    "travel/carrying_blocks": "travel/blocks",
    "tilt/turning_axis": "tilt/axis",
}
"""paths below the case whose names are not those of the records: netCDF takes a dataset of the name of a dimension for
the coordinate of that"""

LOADS = (
    Field(f"{CASE}/dead_load", "float", ("block", "component"), "load", "dead force and moment about the centroid"),
    Field(f"{CASE}/live_load", "float", ("block", "component"), "load", "live force and moment about the centroid"),
    Field(f"{CASE}/dead_words", "text", ("dead_item",), "1", "dead loads in words"),
    Field(f"{CASE}/live_words", "text", ("live_item",), "1", "live loads in words"),
)

_TRAVEL: tuple[tuple[str, FieldKind, tuple[str, ...], UnitKind, str], ...] = (
    ("series", "text", (), "1", "name of the load case in the deck, of which this is one position"),
    ("number", "int", (), "1", "number of the position, from 1"),
    ("count", "int", (), "1", "positions on the path"),
    ("load_points", "float", ("axle", "axis"), "length", "where each axle stands, or the only force"),
    ("distances", "float", ("axle",), "length", "of each from the beginning of the path, the first one first"),
    ("forces", "float", ("axle", "axis"), "force", "force of each; off the path it does not act"),
    ("carrying_blocks", "int", ("axle",), "1", "the block that carries each; -1 off the path"),
)

_TILT: tuple[tuple[str, tuple[str, ...], UnitKind, str], ...] = (
    ("turning_axis", ("axis",), "1", "unit vector about which the table turns, by the right hand"),
    ("fixed", ("block", "component"), "load", "dead load that does not turn"),
    ("turning", ("block", "component"), "load", "dead load that turns, while the table is level"),
    ("across", ("block", "component"), "load", "the same after a turn of 90 degrees"),
    (
        "angle",
        (),
        "degree",
        "angle of collapse, to which live_load leads; nan: none, or see tangent",
    ),
    ("upright", (), "1", "proved multiple of `across` that the level table bears, inf: any, nan: not known"),
)

SPECIAL_LOADS = (
    *(
        Field(f"{CASE}/travel/{name}", kind, dims, unit, words, part="travel")
        for name, kind, dims, unit, words in _TRAVEL
    ),
    *(
        Field(f"{CASE}/tilt/{name}", "float", dims, unit, words, open=not dims, part="tilt")
        for name, dims, unit, words in _TILT
    ),
    Field(f"{CASE}/tilt/tangent", "bool", (), "1", "1 where the load factor is the tangent of the angle", part="tilt"),
)

SETTLEMENT = (
    Field(
        f"{CASE}/settlement/blocks",
        "int",
        ("settling_block",),
        "1",
        "fixed blocks that give way under this case",
        index_of="block",
        part="settlement",
    ),
    Field(
        f"{CASE}/settlement/motions",
        "float",
        ("settling_block", "component"),
        "motion",
        "their velocity and angular velocity in the unit motion of the support",
        part="settlement",
    ),
    Field(
        f"{CASE}/settlement/turns", "bool", (), "1", "1: the support turns, its reaction is a moment", part="settlement"
    ),
    Field(f"{CASE}/settlement/words", "text", (), "1", "the settlement in words", part="settlement"),
    Field(
        f"{CASE}/settlement/reference",
        "float",
        (),
        "load",
        "reaction at rest, a force or a moment; reaction = reference - load factor x unit",
        open=True,
        part="settlement",
    ),
    Field(f"{CASE}/settlement/unit", "float", (), "load", "unit of the loss of reaction", part="settlement"),
    Field(
        f"{CASE}/reaction",
        "float",
        (),
        "load",
        "reaction of the support at which the structure follows it, positive against the motion",
        part="reaction",
    ),
)
