"""A design in words, and as JSON."""

from __future__ import annotations

import json
from typing import Any

from mbla.sweeps.design.design import design_json, design_lines
from tests.sweeps.design.hand_made import design

PARAMETERS: dict[str, Any] = {
    "mu": {"key": "joints.dry.friction", "values": [0.5, 0.65]},
    "t": {"key": "blocks.0.arch.thickness", "linear": {"from": 0.2, "to": 0.3, "points": 3}},
    "shape": {"key": "blocks.0.arch.shape", "values": ["pointed", "segmental"]},
    "tie": {"key": "x.tie", "values": [True, False]},
}


def test_a_design_is_listed_with_parts_counts_and_every_point() -> None:
    found = design(
        PARAMETERS,
        units={"t": "m"},
        design=[{"grid": {"of": ["mu", "t"]}}, {"zip": {}}],
        constraints=["t < mu*0.5", "t > 0.1"],
    )
    assert design_lines(found) == [
        "",
        "Design",
        "------",
        "  grid                            mu (2) × t (3)",
        "  zip                             shape and tie: 2 points",
        "  points                          8",
        "  left out by constraints         4 of 12",
        "    t < mu*0.5                    broken by 4",
        "    t > 0.1                       broken by 0",
        "",
        "Points",
        "------",
        "  point    mu  t [m]      shape    tie",
        "      1   0.5    0.2    pointed   True",
        "      2   0.5    0.2  segmental  False",
        "      3  0.65    0.2    pointed   True",
        "      4  0.65    0.2  segmental  False",
        "      5  0.65   0.25    pointed   True",
        "      6  0.65   0.25  segmental  False",
        "      7  0.65    0.3    pointed   True",
        "      8  0.65    0.3  segmental  False",
    ]


def test_a_design_as_json() -> None:
    found = design(
        {"mu": {"key": "joints.dry.friction", "values": [0.5, 0.6]}, "g": {"key": "g", "horizon": {"points": 2}}},
        vectors={"g": (1.0, 0.0, 2.0)},
        constraints=["mu > 0.55"],
    )
    record = json.loads(json.dumps(design_json(found), allow_nan=False))
    assert record["n_points"] == 2
    assert record["left_out"] == 2
    assert record["constraints"] == [{"text": "mu > 0.55", "broken_by": 2}]
    assert record["dimensions"] == [{"name": "mu", "size": 2}, {"name": "g", "size": 2}]
    assert [column["name"] for column in record["columns"]] == ["mu", "g"]
    assert record["columns"][1]["unit"] == "degree"
    assert record["parts"] == [{"kind": "grid", "parameters": ["mu", "g"], "dimensions": ["mu", "g"], "seed": None}]
    assert record["points"][1] == {
        "number": 2,
        "position": [1, 1],
        "values": {"mu": 0.6, "g": 180.0},
        "settings": {"joints.dry.friction": 0.6, "g": [-1.0, 0.0, 2.0]},
    }
