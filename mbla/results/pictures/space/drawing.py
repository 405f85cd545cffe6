"""A spatial picture before it is rendered: shapes, what is to be seen of them, legend, and a scale of colours."""

from __future__ import annotations

from dataclasses import dataclass

from mbla.arrays import FloatArray
from mbla.results.pictures.space.shapes import Faces, Shape


@dataclass(frozen=True)
class ColourScale:
    """A bar of colours with what it means, from ``low`` to ``high``; colours (n, 3) from the one to the other."""

    label: str
    low: float
    high: float
    colours: FloatArray


@dataclass(frozen=True)
class Drawing:
    """Shapes and how they are told.

    solid  : what hides things, the structure
    marks  : what shines through where the structure hides it
    loads  : marks of the whole, left out where a part of it is enlarged: their arrows are cut there
    shine  : strength of hidden marks, 0 to 1
    extent : (n, 3) m, what must fit into the picture
    legend : names and colours
    scale  : of colours, None without one
    notes  : further lines below the legend
    """

    solid: tuple[Shape, ...]
    marks: tuple[Shape, ...]
    shine: float
    extent: FloatArray
    legend: tuple[tuple[str, str], ...]
    scale: ColourScale | None = None
    notes: tuple[str, ...] = ()
    loads: tuple[Shape, ...] = ()

    def solid_from(self, elevation: float) -> tuple[Shape, ...]:
        """What hides things from an eye at an elevation in degrees: from below all but the ground."""
        if elevation >= 0:
            return self.solid
        return tuple(shape for shape in self.solid if not (isinstance(shape, Faces) and shape.ground))
