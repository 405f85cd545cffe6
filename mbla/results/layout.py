"""The layout of the HDF5 result file as one table: it feeds the writer, the reader's checks and schemas/results.md.

A ``*`` in a path stands for the name of a load case.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from mbla.deck.units import Units

FILETYPE = "mbla results"
VERSION = 1
"""raised by one with every change that an older reader would misread"""

ATTRIBUTES = {
    "filetype": f'"{FILETYPE}"',
    "version": f"version of this layout, {VERSION}; a reader checks it first",
    "mbla_version": "version of the program that ran the analysis",
    "created": "date of the run, UTC, ISO 8601; the only thing that differs between two runs of one deck and its times",
    "deck_sha256": "hash of the effective deck: sources and overrides",
    "complete": "1; an incomplete file is never put in place",
}
"""attributes of the root group"""

SHARED_DIMENSIONS = (
    "block",
    "block_bound",
    "vertex",
    "corner",
    "face",
    "face_bound",
    "interface",
    "interface_bound",
    "point",
    "group",
    "joint",
    "ground",
    "axis",
    "direction",
    "component",
    "pair",
)
"""dimensions with their scale in the root group, where every group sees it; that of others is beside their dataset"""

UnitKind = Literal[
    "1", "time", "length", "area", "volume", "density", "stress", "force", "load", "velocity", "velocities", "motion"
]


@dataclass(frozen=True)
class Field:
    """One dataset.

    dims     : names of its dimensions; none for a single value
    index_of : for indices: the dimension they count (``body`` for blocks and then grounds)
    start_of : for offsets of ragged arrays: the dimension they divide
    open     : non-finite values are allowed: nan for "nothing to say", inf for "unlimited"
    part     : fields of one part are all there or all missing; empty: always there
    """

    path: str
    kind: Literal["float", "int", "bool", "text"]
    dims: tuple[str, ...]
    unit: UnitKind
    long_name: str
    index_of: str = ""
    start_of: str = ""
    open: bool = False
    part: str = ""


def unit_text(kind: UnitKind, units: Units) -> str:
    """The ``units`` attribute, in the deck's units."""
    length, force = units.length, units.force
    return {
        "1": "1",
        "time": "s",
        "length": length,
        "area": f"{length}2",
        "volume": f"{length}3",
        "density": f"{units.mass}/{length}3",
        "stress": f"{force}/{length}2",
        "force": force,
        "load": f"{force}; {force} {length}",
        "velocity": f"1/{force}",
        "velocities": f"1/{force}; 1/({force} {length})",
        "motion": f"1; 1/{length}",
    }[kind]


def _notices(group: str, what: str) -> tuple[Field, ...]:
    return (
        Field(f"{group}/severity", "text", ("notice",), "1", f"{what}: notice or warning"),
        Field(f"{group}/identifier", "text", ("notice",), "1", f"{what}: stable identifier"),
        Field(f"{group}/message", "text", ("notice",), "1", f"{what}: in words"),
    )


def _mechanics(group: str, part: str, what: str) -> tuple[Field, ...]:
    return (
        Field(f"{group}/load_factor", "float", (), "1", f"load factor, {what}", part=part),
        Field(
            f"{group}/contact_forces",
            "float",
            ("point", "direction"),
            "force",
            "contact force N, T1, T2 on body b in the point's frame, compression positive",
            part=part,
        ),
        Field(
            f"{group}/contact_velocities",
            "float",
            ("point", "direction"),
            "velocity",
            "velocity of body b relative to a in the point's frame, opening positive",
            part=part,
        ),
        Field(
            f"{group}/mechanism",
            "float",
            ("block", "component"),
            "velocities",
            "velocity and angular velocity about the centroid, live load power = 1",
            part=part,
        ),
        Field(f"{group}/modes", "int", ("point",), "1", "contact mode: 0 stick, 1 slide, 2 open", part=part),
    )


LAYOUT: tuple[Field, ...] = (
    Field("deck/name", "text", (), "1", "file name of the deck"),
    Field("deck/source_names", "text", ("source",), "1", "files that make the deck, the main one first"),
    Field("deck/source_texts", "text", ("source",), "1", "their text"),
    Field("deck/overrides", "text", ("override",), "1", "values set on the command line"),
    Field("model/title", "text", (), "1", "title of the deck"),
    Field("model/units", "text", ("unit",), "1", "units of length, force, mass"),
    Field("model/load_cases", "text", ("load_case",), "1", "names of the load cases in the order of the deck"),
    Field("model/group_names", "text", ("group",), "1", "names of the groups of blocks, sorted"),
    Field("model/vertices", "float", ("vertex", "axis"), "length", "corners of the blocks; blocks share none"),
    Field("model/vertex_start", "int", ("block_bound",), "1", "first vertex of each block", start_of="vertex"),
    Field(
        "model/loops",
        "int",
        ("corner",),
        "1",
        "vertex at each corner of each face, counter-clockwise seen from outside",
        index_of="vertex",
    ),
    Field("model/loop_start", "int", ("face_bound",), "1", "first corner of each face", start_of="corner"),
    Field("model/face_start", "int", ("block_bound",), "1", "first face of each block", start_of="face"),
    Field("model/facet_of_face", "int", ("face",), "1", "faces of one block in one plane carry one number"),
    Field("model/face_normals", "float", ("face", "axis"), "1", "unit normal, outwards"),
    Field("model/convex", "bool", ("block",), "1", "1 where the block is convex"),
    Field("model/centroids", "float", ("block", "axis"), "length", "centroid"),
    Field("model/volumes", "float", ("block",), "volume", "volume"),
    Field("model/densities", "float", ("block",), "density", "mass per volume"),
    Field("model/weights", "float", ("block",), "force", "weight under standard gravity, 9.81 m/s2"),
    Field("model/groups", "int", ("block",), "1", "group, as row of group_names", index_of="group"),
    Field("model/group_indices", "int", ("block",), "1", "position of the block in its group"),
    Field("model/fixed", "bool", ("block",), "1", "1 where the block does not move"),
    Field("model/joint_names", "text", ("joint",), "1", "names of the joint laws"),
    Field("model/friction", "float", ("joint",), "1", "friction coefficient"),
    Field("model/cohesion", "float", ("joint",), "stress", "cohesion"),
    Field("model/tensile_strength", "float", ("joint",), "stress", "tensile strength"),
    Field(
        "model/compressive_strength", "float", ("joint",), "stress", "compressive strength, inf: unlimited", open=True
    ),
    Field("model/dilatancy", "float", ("joint",), "1", "tangent of the dilatancy angle"),
    Field("model/ground_labels", "text", ("ground",), "1", "ground planes; body number = blocks + row"),
    Field("model/ground_points", "float", ("ground", "axis"), "length", "a point on the plane"),
    Field("model/ground_normals", "float", ("ground", "axis"), "1", "unit normal towards the structure"),
    Field("model/ground_joints", "text", ("ground",), "1", "joint law on the plane"),
    Field("model/ground_selective", "bool", ("ground",), "1", "1 where the plane carries only the blocks listed"),
    Field("model/ground_start", "int", ("ground_bound",), "1", "first listed block", start_of="ground_block"),
    Field("model/ground_blocks", "int", ("ground_block",), "1", "blocks that it may carry", index_of="block"),
    *_notices("model/notices", "from building the model"),
    Field(
        "contacts/bodies", "int", ("interface", "pair"), "1", "bodies a and b: blocks, then grounds", index_of="body"
    ),
    Field("contacts/normals", "float", ("interface", "axis"), "1", "unit normal from a to b"),
    Field("contacts/areas", "float", ("interface",), "area", "area"),
    Field("contacts/centroids", "float", ("interface", "axis"), "length", "centroid"),
    Field("contacts/gaps", "float", ("interface",), "length", "greatest distance of the faces, negative: overlap"),
    Field("contacts/joints", "int", ("interface",), "1", "joint law, as row of joint_names", index_of="used_joint"),
    Field("contacts/joint_names", "text", ("used_joint",), "1", "joint laws in use"),
    Field("contacts/point_start", "int", ("interface_bound",), "1", "first contact point", start_of="point"),
    Field("contacts/outline", "int", ("interface",), "1", "how many of its points form the outer boundary, in order"),
    Field("contacts/points", "float", ("point", "axis"), "length", "contact points"),
    Field("contacts/frames", "float", ("point", "direction", "axis"), "1", "normal, tangent 1, tangent 2 as rows"),
    Field("contacts/point_areas", "float", ("point",), "area", "share of the area of the interface"),
    Field("contacts/report/slivers", "int", ("sliver", "pair"), "1", "bodies of surfaces left out", index_of="body"),
    Field("contacts/report/sliver_widths", "float", ("sliver",), "1", "their width relative to block size"),
    Field(
        "contacts/report/near_misses", "int", ("near_miss", "pair"), "1", "bodies that nearly touch", index_of="body"
    ),
    Field("contacts/report/near_miss_gaps", "float", ("near_miss",), "1", "their distance relative to block size"),
    Field("contacts/report/overlaps", "int", ("overlap", "pair"), "1", "blocks that overlap", index_of="body"),
    Field("contacts/report/overlap_depths", "float", ("overlap",), "1", "the depth relative to block size"),
    Field("contacts/report/unchecked", "int", ("unchecked_pair", "pair"), "1", "overlaps not judged", index_of="body"),
    Field("contacts/report/fixed_contacts", "int", (), "1", "contacts between fixed bodies, left out"),
    Field("contacts/report/isolated", "int", ("isolated_block",), "1", "blocks without contact", index_of="block"),
    Field(
        "contacts/report/unsupported_start",
        "int",
        ("unsupported_bound",),
        "1",
        "first block of each part that reaches no support",
        start_of="unsupported_block",
    ),
    Field(
        "contacts/report/unsupported_blocks",
        "int",
        ("unsupported_block",),
        "1",
        "blocks of these parts",
        index_of="block",
    ),
    *_notices("contacts/notices", "from finding the contacts"),
    Field("cases/*/dead_load", "float", ("block", "component"), "load", "dead force and moment about the centroid"),
    Field("cases/*/live_load", "float", ("block", "component"), "load", "live force and moment about the centroid"),
    Field("cases/*/dead_words", "text", ("dead_item",), "1", "dead loads in words"),
    Field("cases/*/live_words", "text", ("live_item",), "1", "live loads in words"),
    Field("cases/*/status", "text", (), "1", "status of the case after verification", part="solution"),
    Field("cases/*/claimed_status", "text", (), "1", "status that the solver stage claimed", part="solution"),
    Field(
        "cases/*/flow_rule", "text", (), "1", "flow rule of load_factor, contact_forces and mechanism", part="solution"
    ),
    Field("cases/*/reason", "text", (), "1", "why there is no result, in words", part="solution"),
    Field("cases/*/seconds", "float", (), "time", "time of the solver stage", part="solution"),
    *_mechanics("cases/*", "mechanics", "by the deck's flow rule"),
    *_mechanics("cases/*/associative", "associative", "by the associative flow rule, where that is not the deck's"),
    Field(
        "cases/*/certificate",
        "float",
        ("block", "component"),
        "motion",
        "no equilibrium: motion under which the dead load does positive work and no joint resists",
        part="certificate",
    ),
    *(
        Field(f"cases/*/{name}", "float", (), "1", words, open=True, part="solution")
        for name, words in (
            ("equilibrium_residual", "largest unbalanced force over mean block weight"),
            ("yield_violation", "largest excess over the joint's strength over mean block weight"),
            ("penetration", "largest closing velocity over largest contact speed"),
            ("complementarity_residual", "share of the power balance left unexplained under the flow rule"),
            ("live_power", "live load times mechanism, should be 1"),
            ("power_balance", "dissipation minus external power over the larger of the two"),
            ("static_bound", "lower bound of the associative load factor"),
            ("kinematic_bound", "upper bound of the associative load factor"),
            ("gap", "relative distance of the two bounds"),
        )
    ),
    Field("cases/*/verified", "bool", (), "1", "1 where everything is within tolerance", part="solution"),
    Field("cases/*/failures", "text", ("failure",), "1", "what is not, in words", part="solution"),
    Field(
        "cases/*/programs/program", "int", ("program_row",), "1", "number of the cone program, from 1", part="solution"
    ),
    Field("cases/*/programs/kind", "text", ("program_row",), "1", "what it is for", part="solution"),
    Field("cases/*/programs/status", "text", ("program_row",), "1", "its status", part="solution"),
    Field(
        "cases/*/programs/load_factor", "float", ("program_row",), "1", "its load factor", open=True, part="solution"
    ),
    Field(
        "cases/*/programs/change",
        "float",
        ("program_row",),
        "1",
        "relative change of the load factor",
        open=True,
        part="solution",
    ),
    Field("cases/*/programs/iterations", "int", ("program_row",), "1", "its iterations", part="solution"),
    Field("cases/*/programs/seconds", "float", ("program_row",), "time", "its time", part="solution"),
    Field("cases/*/iterations/program", "int", ("iteration_row",), "1", "number of the cone program", part="solution"),
    Field("cases/*/iterations/iteration", "int", ("iteration_row",), "1", "iteration within it", part="solution"),
    *(
        Field(f"cases/*/iterations/{name}", "float", ("iteration_row",), "1", words, open=True, part="solution")
        for name, words in (
            ("load_factor", "load factor at this iteration"),
            ("gap", "relative gap of the cone program"),
            ("primal_residual", "primal residual of the cone program"),
            ("dual_residual", "dual residual of the cone program"),
            ("step", "length of the step taken"),
        )
    ),
    Field(
        "cases/*/iterations/seconds",
        "float",
        ("iteration_row",),
        "time",
        "time since the program began",
        part="solution",
    ),
    *_notices("notices", "all remarks of the run"),
    Field("provenance/names", "text", ("entry",), "1", "programs, libraries, platform"),
    Field("provenance/values", "text", ("entry",), "1", "their versions"),
    Field("provenance/setting_names", "text", ("setting",), "1", "analysis settings in effect"),
    Field("provenance/setting_values", "text", ("setting",), "1", "their values"),
    Field("provenance/stage_names", "text", ("stage",), "1", "stages of the run"),
    Field("provenance/stage_seconds", "float", ("stage",), "time", "time of each stage"),
    Field("provenance/files", "text", ("file",), "1", "names of the files of this run"),
    Field("provenance/exit_code", "int", (), "1", "exit status of the run"),
)


def fields_of_case(name: str) -> tuple[tuple[str, Field], ...]:
    """Path and field of every dataset of one load case."""
    return tuple((f.path.replace("*", name), f) for f in LAYOUT if "*" in f.path)


COMMON_FIELDS: tuple[Field, ...] = tuple(f for f in LAYOUT if "*" not in f.path)


def layout_table() -> str:
    """The datasets as a Markdown table, as it stands in schemas/results.md; units as in a deck in m, N, kg."""
    lines = ["| dataset | type | dimensions | units | content |", "|---|---|---|---|---|"]
    for field in LAYOUT:
        content = field.long_name + (f" (part: {field.part})" if field.part else "")
        dims = ", ".join(field.dims) or "–"
        lines.append(f"| `/{field.path}` | {field.kind} | {dims} | {unit_text(field.unit, Units())} | {content} |")
    return "\n".join(lines) + "\n"
