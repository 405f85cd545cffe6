"""Datasets of a result file that say what was found for a load case; ``*`` stands for its name."""

from __future__ import annotations

from mbla.results.hdf5.field import (
    CLAIMED,
    COURSE,
    FALLS,
    SEARCHES,
    STANDING,
    TIMES,
    WORDS,
    Field,
    FieldKind,
    UnitKind,
)
from mbla.results.hdf5.load_fields import LOADS, SETTLEMENT, SPECIAL_LOADS
from mbla.results.hdf5.mechanism_fields import CASE, COLLAPSE, MECHANICS
from mbla.solution.solution import PROVED_STANDING


def _columns(
    group: str, dimension: str, columns: tuple[tuple[str, FieldKind, UnitKind, str], ...]
) -> tuple[Field, ...]:
    """A table of records of how it was solved, a dataset a column: name, type, unit, meaning; numbers may be nan."""
    return tuple(
        Field(f"{group}/{name}", kind, (dimension,), unit, words, open=kind == "float", part="solution", told=COURSE)
        for name, kind, unit, words in columns
    )


def _numbers(part: str, numbers: tuple[tuple[str, str], ...]) -> tuple[Field, ...]:
    """Single numbers of which some may not exist (nan)."""
    return tuple(Field(f"{CASE}/{name}", "float", (), "1", words, open=True, part=part) for name, words in numbers)


ANSWER = (
    Field(f"{CASE}/status", "text", (), "1", "status of the case after verification", part="solution"),
    Field(
        f"{CASE}/claimed_status",
        "text",
        (),
        "1",
        "status that the solver stage claimed, which figures can lower and not raise",
        part="solution",
        told=CLAIMED,
    ),
    Field(
        f"{CASE}/flow_rule", "text", (), "1", "flow rule of load_factor, contact_forces and mechanism", part="solution"
    ),
    Field(f"{CASE}/contact_model", "text", (), "1", "concave, or convex: interface resultants", part="solution"),
    Field(f"{CASE}/stress_blocks", "bool", (), "1", "1 where interfaces crush as fields of stress do", part="solution"),
    Field(
        f"{CASE}/scheme",
        "text",
        (),
        "1",
        "how a flow without normality was solved; empty: associative",
        part="solution",
        told=COURSE,
    ),
    Field(f"{CASE}/reason", "text", (), "1", "why it is not plainly solved, in words", part="solution", told=WORDS),
    Field(
        f"{CASE}/remarks",
        "text",
        ("remark",),
        "1",
        "what a reader of the figure must know",
        part="solution",
        told=WORDS,
    ),
    Field(f"{CASE}/seconds", "float", (), "time", "time of the solver stage", part="solution", told=TIMES),
    Field(f"{CASE}/sides", "int", (), "1", "of the friction polyhedron, 0: circular cone", part="solution"),
)

REDUCTIONS: tuple[tuple[str, FieldKind, str], ...] = (
    ("name", "text", "the reduction, as in analysis.reductions, or glued"),
    ("state", "text", "applied, nothing found, switched off, would change the answer"),
    ("found", "int", "contact points or blocks left out, or parts taken apart or reduced"),
    *(
        (f"{name}_{when}", "int", f"{words}, {when} it")
        for when in ("before", "after")
        for name, words in (
            ("unknowns", "velocities in the programs with live load"),
            ("cones", "friction cones in these, one a contact point"),
            ("entries", "entries of their equilibrium matrices, other than zero"),
            ("largest", "unknowns of the largest of them"),
        )
    ),
)

FURTHER_ANSWERS = (
    Field(
        f"{CASE}/certificate",
        "float",
        ("block", "component"),
        "motion",
        "no equilibrium: motion under which the dead load does positive work and no joint resists",
        part="certificate",
    ),
    *(
        Field(
            f"{CASE}/certificate_{name}_motions",
            "float",
            ("interface", "component"),
            "motion",
            f"convex contact model: motion of the interfaces by {name} that belongs to the certificate",
            part="certificate motions",
        )
        for name in ("torsion", "crushing")
    ),
    Field(
        f"{CASE}/lock",
        "float",
        ("point", "direction"),
        "force",
        "unbounded: contact forces within the yield conditions that balance the live load alone",
        part="lock",
    ),
    Field(
        f"{CASE}/level/lock",
        "float",
        ("point", "direction"),
        "force",
        "tilting table: contact forces within the yield conditions that balance the load across, of the level table, "
        "alone",
        part="level lock",
    ),
    Field(
        f"{CASE}/spread",
        "float",
        ("end",),
        "1",
        "least and greatest load factor of several tries that did not agree",
        part="spread",
        told=SEARCHES,
    ),
    Field(
        f"{CASE}/asked",
        "float",
        (),
        "1",
        "gap of the bounds or residual that the analysis asks for, of a case that is approximate for no other reason",
        part="asked",
    ),
    Field(
        f"{CASE}/force_ranges",
        "float",
        ("interface", "end"),
        "force",
        "least and greatest normal force at the load factor, inf: unlimited, nan: not found",
        open=True,
        part="force_ranges",
        told=SEARCHES,
    ),
    Field(
        f"{CASE}/standing/verdict",
        "text",
        (),
        "1",
        "whether it stands under its dead load alone: yes or no, which need proofs, only by self-stress, doubtful",
        part="standing",
        told=STANDING,
        proved=tuple(verdict.value for verdict in PROVED_STANDING),
    ),
    Field(
        f"{CASE}/standing/falls",
        "int",
        ("falling_block",),
        "1",
        "the block that falls or would fall first; no entry where none does",
        index_of="block",
        part="standing",
        told=FALLS,
    ),
    Field(f"{CASE}/standing/reason", "text", (), "1", "why, in words", part="standing", told=WORDS),
    Field(
        f"{CASE}/standing/contact_forces",
        "float",
        ("point", "direction"),
        "force",
        "contact forces under the dead load alone, from the stress-free assembly",
        part="standing proof",
    ),
    Field(
        f"{CASE}/standing/settlement",
        "float",
        ("block", "component"),
        "displacement",
        "displacements and rotations that bring them about on joints of unit stiffness",
        part="standing proof",
    ),
    *(
        Field(f"{CASE}/size/{name}", "int", (), "1", words, part="size", told=COURSE)
        for name, words in (
            ("dimension", "2 where it was solved as planar, else 3"),
            ("mirror_planes", "planes of symmetry that were used besides"),
            ("parts", "parts that cannot interact, solved apart"),
            ("free_blocks", "blocks with unknowns"),
            ("contact_points", "contact points with unknowns"),
            ("dropped_points", "contact points that cannot matter, or follow from others by symmetry"),
        )
    ),
    *(
        Field(f"{CASE}/reductions/{name}", kind, ("reduction",), "1", words, part="reductions", told=COURSE)
        for name, kind, words in REDUCTIONS
    ),
    *_columns(
        f"{CASE}/path",
        "path_row",
        (
            ("step", "int", "1", "step of the load path"),
            ("load_factor", "float", "1", "load factor there"),
            ("open", "int", "1", "contact points open"),
            ("slide", "int", "1", "contact points sliding"),
            ("residual", "float", "1", "how badly the state fits the law"),
        ),
    ),
)

CHECKS = (
    *_numbers(
        "solution",
        (
            ("equilibrium_residual", "largest unbalanced force over mean block weight"),
            ("yield_violation", "largest excess over the joint's strength over mean block weight"),
            ("tension_violation", "largest tension beyond the tensile strength over mean block weight"),
            ("penetration", "largest closing velocity over largest contact speed"),
            ("complementarity_residual", "share of the power balance left unexplained under the flow rule"),
            ("slip_residual", "the part of it that sliding against friction leaves unexplained"),
            ("live_power", "live load times mechanism, should be 1"),
            ("power_balance", "dissipation minus external power over the larger of the two"),
            ("static_bound", "lower bound of the associative load factor"),
            ("kinematic_bound", "upper bound of the associative load factor"),
            ("gap", "relative distance of the two bounds"),
            (
                "peak_load_factor",
                "verified greatest load factor of the load path, where that lies above the load factor",
            ),
        ),
    ),
    *_numbers(
        "extent",
        (
            ("least_load_factor", "least load factor that was found; the load factor where that is the only one"),
            ("greatest_load_factor", "the greatest of them, inf: there is no limit"),
        ),
    ),
    Field(
        f"{CASE}/range",
        "float",
        ("end",),
        "1",
        "verified least and greatest load factor for the mechanism found, nan: none",
        open=True,
        part="solution",
    ),
    Field(f"{CASE}/verified", "bool", (), "1", "1 where everything is within tolerance", part="solution"),
    Field(f"{CASE}/failures", "text", ("failure",), "1", "what is not, in words", part="solution"),
)

HISTORY = (
    *_columns(
        f"{CASE}/programs",
        "program_row",
        (
            ("program", "int", "1", "number of the program, from 1"),
            ("kind", "text", "1", "what it is for"),
            ("status", "text", "1", "its status"),
            ("load_factor", "float", "1", "its load factor"),
            ("change", "float", "1", "relative change of the load factor"),
            ("iterations", "int", "1", "its iterations"),
            ("seconds", "float", "time", "its time"),
        ),
    ),
    *(
        Field(f"{CASE}/programs/{name}", "text", ("program_row",), "1", words, part="solution", told=COURSE)
        for name, words in (
            ("solver", "mbla, clarabel or highs; empty: steps of the joint law, no cone program"),
            ("factorization", "library that factorised its linear systems; empty: the solver's own, or none"),
        )
    ),
    Field(f"{CASE}/solver", "text", (), "1", "solver asked for, as analysis.solver", part="solution"),
    *_columns(
        f"{CASE}/iterations",
        "iteration_row",
        (
            ("program", "int", "1", "number of the program"),
            ("iteration", "int", "1", "iteration within it"),
            ("load_factor", "float", "1", "load factor at this iteration"),
            ("gap", "float", "1", "relative gap of the program"),
            ("primal_residual", "float", "1", "primal residual of the program"),
            ("dual_residual", "float", "1", "dual residual of the program"),
            ("step", "float", "1", "length of the step taken"),
            ("seconds", "float", "time", "time since the program began"),
        ),
    ),
)

CASE_FIELDS: tuple[Field, ...] = (
    *LOADS,
    *SPECIAL_LOADS,
    *SETTLEMENT,
    *ANSWER,
    *MECHANICS,
    *COLLAPSE,
    *FURTHER_ANSWERS,
    *CHECKS,
    *HISTORY,
)
