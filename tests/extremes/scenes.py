"""All scenes: every module of this folder that has ``SCENES`` is found by itself."""

from __future__ import annotations

import importlib
import pkgutil

import tests.extremes
from tests.extremes.outcome import Scene

NO_SCENES = ("outcome", "scenes", "table")


def all_scenes() -> tuple[Scene, ...]:
    """Scenes of all modules, in the order of their names; two of one family and name are an error."""
    scenes: list[Scene] = []
    for module in sorted(module.name for module in pkgutil.iter_modules(tests.extremes.__path__)):
        if module not in NO_SCENES and not module.startswith("test_"):
            scenes += getattr(importlib.import_module(f"tests.extremes.{module}"), "SCENES", ())
    names = [(scene.family, scene.name) for scene in scenes]
    twice = {name for name in names if names.count(name) > 1}
    if twice:
        raise ValueError(f"scenes of one name: {sorted(twice)}")
    return tuple(scenes)
