"""What moves in a load case: parts, blocks, interfaces by mode."""

from __future__ import annotations

from mbla.results.collapse.collapse import Collapse
from mbla.results.collapse.interface_modes import InterfaceMode, InterfaceMotion
from mbla.results.collapse.rigid_parts import moving_blocks as free_blocks_that_move
from mbla.results.collapse.rigid_parts import moving_share
from mbla.results.quantities.group import Field, Group, count
from mbla.results.quantities.points import FIGURES_WORDS, figure_names
from mbla.results.record.scene import FIGURES, Scene

SCENE = Group[Scene](lambda scene: scene, table="cases")
_MOVING = Group[Scene](lambda scene: None if scene.collapse is None else scene, files="table", table="cases")
_COLLAPSE = Group[Collapse](lambda scene: scene.collapse, files="table", table="cases")
_INTERFACES = Group[InterfaceMotion](lambda scene: scene.interfaces, table="cases")


@SCENE.quantity("table", words=FIGURES_WORDS, names=figure_names)
def figures(scene: Scene) -> int:
    """As a number."""
    return FIGURES.index(scene.figures)


@_MOVING.quantity()
def moving_weight_share(scene: Scene) -> float:
    """Share of the weight of the free blocks that moves."""
    return moving_share(scene.model, scene.parts)


@_MOVING.quantity()
def moving_blocks(scene: Scene) -> int:
    """Free blocks that move."""
    return free_blocks_that_move(scene.model, scene.parts)


_COLLAPSE.fields(Collapse, moving_parts=Field("rigid parts that move", attribute="motions", by=count))


def _declare_mode(mode: InterfaceMode) -> None:
    def count(interfaces: InterfaceMotion) -> int:
        return interfaces.count(mode)

    count.__doc__ = f"interfaces of mode {mode.name.lower()}"
    _INTERFACES.quantity("table", name=f"{mode.name.lower()}_interfaces")(count)


for _mode in InterfaceMode:
    _declare_mode(_mode)
