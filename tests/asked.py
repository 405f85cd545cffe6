"""What the question of a load case is about, for tests that know which question it is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from mbla.arrays import FloatArray
from mbla.model.model import LoadCase
from mbla.questions.angle import Angle
from mbla.questions.reaction import Reaction, Settlement
from mbla.questions.tilt import Tilt


def tilt_of(case: LoadCase) -> Tilt:
    assert isinstance(case.question, Angle)
    return case.question.tilt


def settlement_of(case: LoadCase) -> Settlement:
    assert isinstance(case.question, Reaction)
    return case.question.settlement


def with_loads(case: LoadCase, changed: Callable[[FloatArray], FloatArray]) -> LoadCase:
    """The load case with all its loads on blocks, (n_blocks, 6), changed."""
    question = Angle(tilt_of(case).with_loads(changed)) if case.question.tilts else case.question
    return replace(case, dead_load=changed(case.dead_load), live_load=changed(case.live_load), question=question)
