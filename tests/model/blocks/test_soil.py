"""Item `soil`: its keys; its cells are tested in tests/model/soil, as they fit what lies beside them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from pydantic import ValidationError

from mbla.model.blocks.generated import ItemContext
from mbla.model.blocks.soil import SoilItem, generate

KEYS = {
    "material": "earth",
    "outline": [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0)],
    "width": 1.0,
    "cells": {"size": 0.5},
    "friction_angle": 30.0,
}


def soil(**keys: Any) -> SoilItem:
    return SoilItem.model_validate(KEYS | keys)


def test_it_makes_nothing_before_all_others_are_made() -> None:
    assert generate(soil(), ItemContext(1e-3, lambda path, name: Path(name))).parts == ()


def test_defaults_are_dry_soil_without_dilatancy() -> None:
    found = soil()
    assert (found.cohesion, found.tensile_strength, found.dilatancy) == (0, 0, 0)
    assert (found.wall.friction_angle, found.wall.cohesion) == (None, 0)


@pytest.mark.parametrize("keys", [{"dilatancy": 31.0}, {"tensile_strength": 1.0}, {"cells": {"size": 1, "beyond": 1}}])
def test_refused(keys: dict[str, Any]) -> None:
    with pytest.raises(ValidationError):
        soil(**keys)
