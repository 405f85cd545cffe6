"""Keys of the JSON record that tell the failure: clusters, main parts, lines between them, what is enough."""

from __future__ import annotations

from mbla.results.record.quantity import UnitKind
from mbla.results.records.key import Key

MECHANISM = "cases[].mechanism"
_YIELD = f"{MECHANISM}.yield_lines"
_LINES, _PLANES, _CRACKS = (f"{MECHANISM}.{name}" for name in ("hinge_lines", "sliding_planes", "cracks"))


def part_keys(owner: str) -> tuple[Key, ...]:
    """The keys of a rigid part, or a cluster of parts taken for one."""
    return (
        Key(f"{owner}[]", "object", "one of them"),
        Key(f"{owner}[].part", "integer", "number, from 1, the heaviest first"),
        Key(f"{owner}[].blocks", "integer", "its blocks"),
        Key(f"{owner}[].groups", "object", "its blocks by group"),
        Key(f"{owner}[].groups.*", "integer", "blocks of a group"),
        Key(f"{owner}[].weight", "number", "weight under standard gravity", "force"),
        Key(f"{owner}[].motion", "string", "turns or moves"),
        Key(f"{owner}[].axis_point", "list?", "where it turns: the point of its axis nearest to its centroid"),
        Key(f"{owner}[].axis_point[]", "number?", "a coordinate", "length"),
        Key(f"{owner}[].direction", "list", "unit vector of the axis by the right hand, or of the travel"),
        Key(f"{owner}[].direction[]", "number", "a component"),
    )


def _pair_keys(owner: str, act: str) -> tuple[Key, ...]:
    """What hinge lines, sliding planes and cracks have in common."""
    return (
        Key(f"{owner}[]", "object", "one of them"),
        Key(f"{owner}[].clusters", "list", f"the cluster that {act}, and the other; 0 is at rest"),
        Key(f"{owner}[].clusters[]", "integer", "a cluster"),
        Key(f"{owner}[].interfaces", "list", "its interfaces"),
        Key(f"{owner}[].interfaces[]", "integer", "number of an interface, from 0"),
    )


def _vector_keys(owner: str, item: str, unit: UnitKind, *names: tuple[str, str]) -> tuple[Key, ...]:
    """Keys of vectors by name, and of what they hold."""
    return tuple(
        key
        for name, words in names
        for key in (
            Key(f"{owner}[].{name}", "list", words),
            Key(f"{owner}[].{name}[]", "number", item, unit),
        )
    )


def _point_keys(owner: str, *names: tuple[str, str]) -> tuple[Key, ...]:
    return _vector_keys(owner, "a coordinate", "length", *names)


def _direction_keys(owner: str, *names: tuple[str, str]) -> tuple[Key, ...]:
    return _vector_keys(owner, "a component", "1", *names)


FAILURE: tuple[Key, ...] = (
    Key(
        f"{MECHANISM}.clusters_merged",
        "number",
        "share of the largest contact speed up to which rigid parts were taken for one; 0: none were",
    ),
    Key(f"{MECHANISM}.clusters", "list", "rigid parts as they are told, those that move, at most 100"),
    *part_keys(f"{MECHANISM}.clusters"),
    Key(_LINES, "list", "axes about which one cluster turns relative to another, that which moves most first"),
    *_pair_keys(_LINES, "turns"),
    *_point_keys(_LINES, ("start", "start of the line"), ("end", "its end")),
    Key(f"{_LINES}[].length", "number", "its length", "length"),
    *_direction_keys(_LINES, ("direction", "unit vector from start to end, for the first by the right hand")),
    Key(f"{_LINES}[].rotation", "number", "the largest relative angular velocity of its interfaces", "rotation"),
    Key(f"{_LINES}[].share", "number", "its largest contact speed over the largest of all"),
    Key(f"{_LINES}[].slides", "boolean", "whether closed points of it slide too"),
    Key(f"{_LINES}[].crushes", "boolean", "whether closed points of it crush too"),
    Key(f"{_LINES}[].shear_power_share", "number?", "share of the power put in that its shear forces dissipate"),
    Key(_PLANES, "list", "planes on which one cluster slides over another, that which dissipates most first"),
    *_pair_keys(_PLANES, "slides"),
    Key(f"{_PLANES}[].area", "number", "area of its interfaces", "area"),
    *_point_keys(_PLANES, ("centroid", "their centroid")),
    *_direction_keys(
        _PLANES,
        ("normal", "unit vector towards the cluster that slides"),
        ("direction", "unit vector in which it slides over the other"),
    ),
    Key(f"{_PLANES}[].twists", "boolean", "whether it slides by turning about the normal"),
    Key(f"{_PLANES}[].power_share", "number?", "share of the power put in that is dissipated there"),
    Key(f"{_PLANES}[].shear_power_share", "number?", "the same of the shear forces alone"),
    Key(f"{_PLANES}[].share", "number", "its largest contact speed over the largest of all"),
    Key(_CRACKS, "list", "open joints between two clusters, those that open most first"),
    *_pair_keys(_CRACKS, "moves away"),
    *_point_keys(_CRACKS, ("start", "centroid of its first interface"), ("end", "of its last")),
    Key(f"{_CRACKS}[].length", "number", "its length", "length"),
    Key(f"{_CRACKS}[].area", "number", "area of its interfaces", "area"),
    *_point_keys(_CRACKS, ("widest", "the contact point at which it opens most")),
    Key(f"{_CRACKS}[].share", "number", "opening speed there over the largest contact speed of all"),
    Key(
        f"{MECHANISM}.main_parts",
        "list",
        "the few parts as which it moves; the clusters where these are few",
    ),
    *part_keys(f"{MECHANISM}.main_parts"),
    Key(f"{MECHANISM}.main_parts_explain", "number", "share of the motion, of its square, that they explain"),
    Key(_YIELD, "list", "lines along which main parts break off, the longest first"),
    Key(f"{_YIELD}[]", "object", "one of them"),
    Key(f"{_YIELD}[].parts", "list", "the main parts on both sides; 0 is at rest and comes second"),
    Key(f"{_YIELD}[].parts[]", "integer", "a main part"),
    Key(f"{_YIELD}[].interfaces", "list", "its interfaces"),
    Key(f"{_YIELD}[].interfaces[]", "integer", "number of an interface, from 0"),
    Key(f"{_YIELD}[].points", "list", "its ends and corners, the lowest end first"),
    Key(f"{_YIELD}[].points[]", "list", "a point"),
    Key(f"{_YIELD}[].points[][]", "number", "a coordinate", "length"),
    Key(f"{_YIELD}[].length", "number", "its length", "length"),
    Key(f"{_YIELD}[].inclination", "number", "to the horizontal, from end to end", "degree"),
    Key(f"{_YIELD}[].off", "number", "distance of the interfaces from it over its length, root of the mean square"),
    Key(f"{MECHANISM}.force_freedom", "object?", "how unique the forces are; null where that was not determined"),
    Key(f"{MECHANISM}.force_freedom.ways", "integer", "ways in which equilibrium lets the forces vary; 0: unique"),
    Key(f"{MECHANISM}.force_freedom.determined", "integer", "interfaces whose resultant is the same in all of them"),
    Key(f"{MECHANISM}.enough", "object", "the part of the structure that is enough for this load factor"),
    Key(f"{MECHANISM}.enough.moving_blocks", "integer", "blocks that move"),
    Key(f"{MECHANISM}.enough.interfaces", "integer", "interfaces on them"),
    Key(f"{MECHANISM}.enough.bearing_blocks", "integer", "free blocks at rest that these touch"),
    Key(f"{MECHANISM}.enough.left_out_blocks", "integer", "free blocks at rest that touch nothing that moves"),
)
