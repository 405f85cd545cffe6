"""Datasets of forces and velocities of a load case, and of what follows from them; ``*`` stands for its name."""

from __future__ import annotations

from mbla.results.hdf5.field import PASSED, Field

CASE = "cases/*"

MECHANICS_GROUPS = (
    ("", "mechanics", "by the deck's flow rule"),
    ("associative/", "associative", "by the associative flow rule, where that is not the deck's"),
    ("lower/", "lower", "the least for the mechanism found"),
    ("upper/", "upper", "the greatest for the mechanism found"),
    ("peak/", "peak", "the greatest of the load path, passed before the structure comes to rest"),
    ("outer/", "outer", "with the circumscribed friction polyhedron"),
    ("level/", "level", "of the level table with the load across, by the associative flow rule"),
)
"""group below the case, name of the part, and whose forces and velocities they are"""


def _mechanics(group: str, part: str, what: str) -> tuple[Field, ...]:
    told = PASSED if part == "peak" else ""
    return (
        Field(f"{group}load_factor", "float", (), "1", f"load factor, {what}", part=part),
        Field(
            f"{group}contact_forces",
            "float",
            ("point", "direction"),
            "force",
            "contact force N, T1, T2 on body b in the point's frame, compression positive",
            part=part,
        ),
        Field(
            f"{group}contact_velocities",
            "float",
            ("point", "direction"),
            "velocity",
            "velocity of body b relative to a in the point's frame, opening positive",
            part=part,
            told=told,
        ),
        Field(
            f"{group}mechanism",
            "float",
            ("block", "component"),
            "velocities",
            "velocity and angular velocity about the centroid, live load power = 1",
            part=part,
            told=told,
        ),
        Field(
            f"{group}modes",
            "int",
            ("point",),
            "1",
            "contact mode: 0 stick, 1 slide, 2 open, 3 crush",
            part=part,
            told=told,
        ),
        Field(
            f"{group}residual",
            "float",
            (),
            "1",
            "by how much these forces and velocities miss the joint law at most, nan where nothing moves",
            open=True,
            part=part,
        ),
        *_resultants(group, part),
    )


def _resultants(group: str, part: str) -> tuple[Field, ...]:
    """Those of the convex contact model alone."""
    return (
        Field(
            f"{group}resultants",
            "float",
            ("interface", "component"),
            "load",
            "convex contact model: N, T1, T2 and moments about normal, tangent 1, tangent 2 at the centroid, on body b",
            part=f"{part} resultants",
        ),
        *(
            Field(
                f"{group}{name}_motions",
                "float",
                ("interface", "component"),
                "velocities",
                f"convex contact model: motion of the interface that {name} allows it, dual to the resultants",
                part=f"{part} resultants",
            )
            for name in ("torsion", "crushing")
        ),
    )


MECHANICS = tuple(
    field for group, part, what in MECHANICS_GROUPS for field in _mechanics(f"{CASE}/{group}", part, what)
)

COLLAPSE = (
    Field(
        f"{CASE}/parts",
        "int",
        ("block",),
        "1",
        "rigid part of each block, 0 at rest, the others from the heaviest on; follows from the mechanism",
        part="mechanics",
    ),
    Field(
        f"{CASE}/interfaces/modes",
        "int",
        ("interface",),
        "1",
        "mode: 0 stick, 1 slide, 2 open, 3 hinge, 4 twist, 5 crush; follows from the mechanism, as do the next four",
        part="mechanics",
    ),
    Field(
        f"{CASE}/interfaces/translations",
        "float",
        ("interface", "axis"),
        "velocity",
        "velocity of b relative to a at the centroid",
        part="mechanics",
    ),
    Field(
        f"{CASE}/interfaces/rotations",
        "float",
        ("interface", "axis"),
        "rotation",
        "angular velocity of b relative to a",
        part="mechanics",
    ),
    Field(
        f"{CASE}/interfaces/hinge_points",
        "float",
        ("interface", "axis"),
        "length",
        "a point on the axis of a hinge, nan for other modes",
        open=True,
        part="mechanics",
    ),
    Field(
        f"{CASE}/interfaces/hinge_directions",
        "float",
        ("interface", "axis"),
        "1",
        "its direction, by the right hand for b against a, nan for other modes",
        open=True,
        part="mechanics",
    ),
    Field(
        f"{CASE}/interfaces/work",
        "float",
        ("interface",),
        "1",
        "power dissipated, that of the live load being the load factor; follows from forces and mechanism",
        part="mechanics",
    ),
)
"""written for others to read; mbla finds them anew from forces and mechanism, so that nothing can contradict these"""
