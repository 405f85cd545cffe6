"""The scene of a small deck, for tests of what reductions look at."""

from __future__ import annotations

from mbla.program.reductions.scene import ProgramGeometry, scene_of
from tests.line import line_of


def scene(text: str, *overrides: str) -> ProgramGeometry:
    """Of the program of the whole model under the first load case."""
    line = line_of(text, *overrides)
    return scene_of(line.model, line.contacts, line.program)
