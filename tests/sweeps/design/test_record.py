from __future__ import annotations

import json

from mbla.sweeps.design.design import design_json
from tests.sweeps.design.hand_made import design


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
    assert "points" not in design_json(found, points=False)
