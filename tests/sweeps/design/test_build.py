from __future__ import annotations

from typing import Any

from hypothesis import given, settings
from hypothesis import strategies as st

from tests.sweeps.design.hand_made import column, design

MU = {"key": "joints.dry.friction", "values": [0.5, 0.6, 0.7]}
T = {"key": "blocks.0.t", "values": [1, 2]}


def test_the_last_parameter_of_a_grid_changes_fastest() -> None:
    found = design({"mu": MU, "t": T})
    assert [point.values for point in found.points] == [(0.5, 1), (0.5, 2), (0.6, 1), (0.6, 2), (0.7, 1), (0.7, 2)]
    assert [(dimension.name, dimension.size) for dimension in found.dimensions] == [("mu", 3), ("t", 2)]
    assert [column.dimension for column in found.columns] == ["mu", "t"]
    assert found.points[3].position == (1, 1)
    assert found.points[3].settings == {"joints.dry.friction": 0.6, "blocks.0.t": 2}


def test_a_zip_takes_first_with_first() -> None:
    found = design({"mu": MU, "t": {"key": "t", "values": [1, 2, 3]}}, design=[{"zip": {}}])
    assert [point.values for point in found.points] == [(0.5, 1), (0.6, 2), (0.7, 3)]
    assert [dimension.name for dimension in found.dimensions] == ["zip"]


def test_parts_are_combined_and_the_rest_goes_to_the_part_that_names_none() -> None:
    parameters = {"mu": MU, "g": {"key": "g", "uniform": {"from": 1, "to": 2}}, "t": T}
    found = design(parameters, design=[{"random": {"of": ["g"], "points": 3, "seed": 7}}, {"grid": {}}])
    assert [(dimension.name, dimension.size) for dimension in found.dimensions] == [("random", 3), ("mu", 3), ("t", 2)]
    assert [(part.kind, part.parameters, names, part.seed) for part, names in found.parts] == [
        ("random", ("g",), ("random",), 7),
        ("grid", ("mu", "t"), ("mu", "t"), None),
    ]
    assert len(found.points) == 18
    assert len(set(column(found, "g"))) == 3


def test_a_value_goes_to_every_key_and_to_the_parameter_of_the_deck_where_none_is_given() -> None:
    parameters = {
        "both": {"key": ["a.x", "b.x"], "values": [1]},
        "mu": {"values": [2]},
        "joints.dry.cohesion": {"values": [3]},
    }
    [point] = design(parameters).points
    assert point.settings == {"a.x": 1, "b.x": 1, "parameters.mu": 2, "joints.dry.cohesion": 3}


def test_the_order_of_parameters_does_not_change_what_is_drawn() -> None:
    names = ("a", "b", "c")
    parameters = {name: {"key": name, "uniform": {"from": 0, "to": 1}} for name in names}
    backwards = {name: parameters[name] for name in reversed(names)}
    for kind in ("random", "latin_hypercube", "sobol"):
        one, other = (design(p, design=[{kind: {"points": 8}}]) for p in (parameters, backwards))
        assert [dict(point.settings) for point in one.points] == [dict(point.settings) for point in other.points]


def _part(kind: str, names: list[str], points: int) -> dict[str, Any]:
    sampled = {} if kind in ("grid", "zip") else {"points": points}
    return {kind: {"of": names, **sampled}}


@st.composite
def designs(draw: st.DrawFn) -> tuple[dict[str, Any], list[dict[str, Any]]]:
    """Parts of every kind over parameters of their own."""
    parameters: dict[str, Any] = {}
    parts: list[dict[str, Any]] = []
    for number in range(draw(st.integers(1, 3))):
        kind = draw(st.sampled_from(["grid", "zip", "random", "latin_hypercube", "sobol"]))
        size = draw(st.integers(1, 4))
        names = [f"p{number}_{i}" for i in range(draw(st.integers(1, 2)))]
        for name in names:
            own = draw(st.integers(1, 4)) if kind == "grid" else size
            parameters[name] = {"key": name, "values": list(range(own))}
        parts.append(_part(kind, names, size))
    return parameters, parts


@settings(max_examples=60)
@given(designs(), st.booleans())
def test_a_design_is_the_product_of_its_parts(drawn: tuple[dict[str, Any], list[dict[str, Any]]], cut: bool) -> None:
    parameters, parts = drawn
    found = design(parameters, design=parts, constraints=["p0_0 <= 1"] if cut else [])
    sizes = [dimension.size for dimension in found.dimensions]
    whole = 1
    for size in sizes:
        whole *= size
    positions = [point.position for point in found.points]
    assert [point.number for point in found.points] == list(range(1, len(positions) + 1))
    assert len(positions) + found.left_out == whole
    assert positions == sorted(set(positions))  # each once, the last dimension fastest
    assert all(0 <= place < size for position in positions for place, size in zip(position, sizes, strict=True))
    along = {dimension.name: i for i, dimension in enumerate(found.dimensions)}
    assert set(along) == {column.dimension for column in found.columns}
    for i, column_ in enumerate(found.columns):  # a value depends on the position along its own axis alone
        by_place = {(point.position[along[column_.dimension]], point.values[i]) for point in found.points}
        assert len(by_place) == len({place for place, _ in by_place})
    names = [column.name for column in found.columns]
    assert all([point.settings[name] for name in names] == list(point.values) for point in found.points)
    assert found.left_out == (whole - len(positions) if cut else 0)
    assert not cut or all(place <= 1 for place in column(found, "p0_0"))
