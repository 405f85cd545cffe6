"""What forces ask of the units, as an object of the JSON record."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.results.demand.cracking import Cracking, cracking_of
from mbla.results.demand.demand import strength_use as use_of
from mbla.results.record.objects import Object
from mbla.results.record.scene import Scene

MOST = 100
"""units that the record names, the most exceeded first"""
UNIT_STRESS = Object[Scene](owner=lambda scene: None if scene.demand is None else scene, on_demand=True)


def _greatest(scene: Scene, found: FloatArray) -> tuple[float, str | None]:
    """Value and name of the block; nan and none where no block is judged."""
    if np.isnan(found).all():
        return np.nan, None
    block = int(np.nanargmax(found))
    return float(found[block]), scene.model.blocks.name(block)


def _declare(name: str, attribute: str, words: str) -> None:
    @UNIT_STRESS.key(name=name, words=words, unit="stress")
    def value(scene: Scene) -> float | None:
        """The value."""
        return _greatest(scene, getattr(scene.demand, attribute))[0]

    @UNIT_STRESS.key(name=f"{name}_block", words="where that is")
    def block(scene: Scene) -> str | None:
        """The name."""
        return _greatest(scene, getattr(scene.demand, attribute))[1]


_declare("bending_tension", "bending", "greatest tension of a unit by bending")
_declare("splitting_tension", "splitting", "greatest tension across the struts of a unit")
_declare(
    "joint_pressure",
    "pressure",
    "greatest even pressure on the joints of a unit; of one that does not crush over a tenth of it at least",
)


@UNIT_STRESS.key()
def strength_use(scene: Scene) -> float | None:
    """Greatest of these over the strength of the material; null where none is given."""
    assert scene.demand is not None  # the owner
    return _greatest(scene, use_of(scene.assembly, scene.demand))[0]


def _cracking(scene: Scene) -> Cracking | None:
    return cracking_of(scene.assembly, scene.solved)


@UNIT_STRESS.key("a unit")
def may_crack(scene: Scene) -> list[str]:
    """Units that may crack, the most exceeded first."""
    found = _cracking(scene)
    return [] if found is None else [scene.model.blocks.name(int(block)) for block in found.blocks[:MOST]]


@UNIT_STRESS.key()
def cracks_at(scene: Scene) -> float | None:
    """Load factor at which the first of them does with forces in proportion to the load; null where none is known."""
    found = _cracking(scene)
    return None if found is None else found.factor
