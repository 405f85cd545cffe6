"""The coefficients of the codes: ``coefficients.toml``."""

from __future__ import annotations

import tomllib
from functools import cache
from importlib.resources import files
from typing import Any


@cache
def _tables() -> dict[str, dict[str, Any]]:
    return tomllib.loads(files("mbla.codes").joinpath("coefficients.toml").read_text(encoding="utf-8"))


def coefficients(table: str) -> dict[str, Any]:
    """A table of coefficients by its name; KeyError where there is none."""
    return _tables()[table]
