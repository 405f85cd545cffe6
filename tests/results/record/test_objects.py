"""Objects of the JSON record: keys by the types of what they tell, groups of quantities in them, values on demand."""

from __future__ import annotations

from dataclasses import dataclass, field

from mbla.results.quantities.group import Field, Group, count
from mbla.results.record.objects import Object, json_of, keys_of


@dataclass(frozen=True)
class Stone:
    name: str = ""
    mass: float = float("nan")
    place: tuple[float, float] = (1.0, 2.0)


@dataclass(frozen=True)
class Wall:
    stones: tuple[Stone, ...] = ()
    cap: Stone | None = None
    notes: dict[str, int] = field(default_factory=dict)


STONES = Group[tuple[Stone, ...]](lambda wall: wall.stones or None, rows="stone")
STONES.fields(
    Stone,
    name=Field("what it is called", rule="open"),
    mass=Field("its mass", unit="mass", rule="open"),
    place=Field("where it is", "axis", unit="length"),
)
CAP = Group[Stone](lambda wall: wall.cap)
CAP.fields(Stone, mass=Field("its mass", unit="mass"))
WALL = Object[Wall]()
WALL.holds("stones", STONES, "stones", "a stone")
WALL.holds("cap", CAP, "the uppermost one")
WALL.of(lambda wall: wall.stones).key(name="count", words="how many")(count)
WALL.fields(Wall, notes=Field("of masons", items=("a note",), missing=True))


def test_a_group_is_an_object_or_a_list_of_them() -> None:
    wall = Wall((Stone("a", 2.0), Stone()), Stone(mass=1.0), {"x": 1})
    assert json_of(WALL, wall) == {
        "stones": [{"name": "a", "mass": 2.0, "place": [1.0, 2.0]}, {"name": None, "mass": None, "place": [1.0, 2.0]}],
        "cap": {"mass": 1.0},
        "count": 2,
        "notes": {"x": 1},
    }


def test_where_there_is_nothing() -> None:
    assert json_of(WALL, Wall()) == {"stones": [], "cap": None, "count": 0}


def test_keys_say_the_types_of_values() -> None:
    assert [(key.path, key.kind, key.unit, key.words) for key in keys_of(WALL, "wall.")] == [
        ("wall.stones", "list", "1", "stones"),
        ("wall.stones[]", "object", "1", "a stone"),
        ("wall.stones[].name", "string?", "1", "what it is called"),
        ("wall.stones[].mass", "number?", "mass", "its mass"),
        ("wall.stones[].place", "list", "1", "where it is"),
        ("wall.stones[].place[]", "number", "length", "a coordinate"),
        ("wall.cap", "object?", "1", "the uppermost one"),
        ("wall.cap.mass", "number", "mass", "its mass"),
        ("wall.count", "integer", "1", "how many"),
        ("wall.notes", "object", "1", "of masons"),
        ("wall.notes.*", "integer", "1", "a note"),
    ]


def test_values_on_demand_are_found_when_they_are_asked_for() -> None:
    asked: list[str] = []
    lazy = Object[Wall](on_demand=True)

    @lazy.key()
    def stones(wall: Wall) -> int:
        """Stones."""
        asked.append("stones")
        return len(wall.stones)

    record = json_of(lazy, Wall())
    assert (list(record), asked) == (["stones"], [])
    assert (record["stones"], asked) == (0, ["stones"])
