"""Values of a function of one variable that are known to some accuracy, and where it is zero by them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar


class Sample(Protocol):
    """A value of the function.

    x           : where
    y           : infinite where only the side is known, nan where nothing is
    slope       : nan without one
    uncertainty : absolute, of y: |y| up to it counts as zero; 0 where the sign counts however small y is
    scatter     : absolute, of y: steps of the function up to it are none of what it describes; 0 of a smooth function
    """

    @property
    def x(self) -> float: ...  # noqa: D102
    @property
    def y(self) -> float: ...  # noqa: D102
    @property
    def slope(self) -> float: ...  # noqa: D102
    @property
    def uncertainty(self) -> float: ...  # noqa: D102
    @property
    def scatter(self) -> float: ...  # noqa: D102


S = TypeVar("S", bound=Sample)


@dataclass(frozen=True)
class Zero(Generic[S]):
    """Where the function is zero: a value, or a stretch of values.

    best     : the sample nearest to it; of a stretch that at its lower end
    bracket  : the nearest samples below and above zero; of a stretch those before and after it, its own where it ends
               with the samples
    error    : of ``best.x``: its value over its slope, but no more than the bracket is wide, and no less than what the
               value may be off over the slope; where the function scatters, what it scatters over its mean slope; of a
               stretch that of the end that is known less well
    complete : the error is as small as it was to be, or as it can be
    jumps    : the function is further from zero on both sides than it is known and than its slopes there explain
    stretch  : the samples at both ends; the same one where the function only touches zero; None of a single value
    """

    best: S
    bracket: tuple[S, S]
    error: float
    complete: bool
    jumps: bool = False
    stretch: tuple[S, S] | None = None

    @property
    def rises(self) -> bool:
        """Whether the function rises through a single value."""
        below, above = self.bracket
        return below.x < above.x or (below.x == above.x and self.best.slope > 0.0)


def is_zero(sample: Sample) -> bool:
    """Whether the function is zero there, as far as it is known."""
    return sample.uncertainty > 0.0 and abs(sample.y) <= sample.uncertainty


def steep(sample: Sample, width: float) -> bool:
    """Whether the slope, over a width of x, is more than the function may be off; without a slope it is not."""
    return abs(sample.slope) * width > sample.uncertainty


def apart(one: Sample, other: Sample) -> bool:
    """Whether the function, by its slopes, is not the same between two samples, whatever their values."""
    width = abs(other.x - one.x)
    return steep(one, width) and steep(other, width)


def level(one: Sample, other: Sample) -> bool:
    """Whether the function is the same at two samples as far as it is known, and no slopes speak against it between."""
    return abs(other.y - one.y) <= max(one.uncertainty, other.uncertainty) and not apart(one, other)
