"""Motion of the base and forces over time, of a load case's `time_history`: from files, or as pulses."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal, TypeAlias

from pydantic import Field

from mbla.deck.quantities import (
    BaseAcceleration,
    Direction,
    Integer,
    NonNegativeTime,
    Number,
    Point,
    PositiveNumber,
    Time,
    UnitOfAcceleration,
    UnitOfForce,
)
from mbla.deck.section import ByShape, Section, exactly_one_of, given, rule
from mbla.deck.sections.selectors import Selector
from mbla.errors import Finding

AXES = ("x", "y", "z")
CORNER = 0.1
"""Hz, of the high-pass filter unless the deck gives another: half of a record that has few seconds or is old is noise
below it, and what masonry rocks with is above"""

Along: TypeAlias = Annotated[Literal["x", "y", "z", "-x", "-y", "-z"] | Direction, ByShape("list")]
"""A direction by its axis, or a vector of any length."""
Column: TypeAlias = Annotated[
    Annotated[str, Field(min_length=1)] | Annotated[int, Integer(ge=1, le=1000)], Field(union_mode="left_to_right")
]
"""Of a file with columns: its name in the header, or its number from 1."""
Columns: TypeAlias = Annotated[list[Column], Field(min_length=1, max_length=4)]


FILE = (
    "file with values over time, relative to the deck: CSV, with commas, semicolons or blanks between columns; lines "
    "before the first time are headers; or AT2 of PEER, with values only and NPTS and DT in its header. Values are "
    "linear in between, zero before and after"
)


class OverTime(Section):
    """What is said of values over time."""

    columns: Columns | None = Field(
        None,
        description="CSV: columns of time in seconds, then of values, by their names in a header or their numbers from "
        "1; default: the first two",
    )
    interval: Time | None = Field(
        None,
        description="CSV without times: between one value and the next, s; columns are those of values, by default the "
        "first",
    )
    scale: Number = Field(1.0, description="factor on the values")
    start: NonNegativeTime = Field(0.0, description="when it begins, s; the first time of a file counts from there")

    @property
    def count(self) -> int:
        """How many columns of values there are."""
        return 1 if self.columns is None else len(self.columns) - (self.interval is None)


RECORD_KEYS, PULSE_KEYS = ("columns", "interval", "unit", "directions", "baseline", "corner"), ("amplitude", "duration")


@exactly_one_of("file", "pulse")
class MotionSection(OverTime):
    """Acceleration of the base over time: of a record in a file, or a pulse. Several add up.

    A pulse of the duration t_p and the amplitude a is rectangle: a; half_sine: a sin(π t/t_p); sine: a sin(2π t/t_p),
    one full wave; dejong: a for t_p, then −a/2 for 2 t_p, after which the base is at rest.
    """

    file: str | None = Field(None, min_length=1, description=FILE)
    unit: UnitOfAcceleration | None = Field(
        None, description="unit of the values of the file: g (9.81 m/s^2), m/s2, cm/s2 (gal) or another; with file"
    )
    direction: Along | None = Field(
        None, description="along which the base is accelerated: x, y, z, -x, -y, -z or a vector of any length"
    )
    directions: Annotated[list[Along], Field(min_length=2, max_length=3)] | None = Field(
        None, description="of a file with two or three columns of values: one for each; default: x, y, z"
    )
    baseline: Literal["none", "linear", "highpass"] = Field(
        "none",
        description="correction of a record. linear: less the straight line that fits its accelerations best, with "
        "which velocity and displacement at its end are zero; highpass: Butterworth filter of fourth order forwards "
        "and backwards, which shifts no phase, between zeros on both sides, then linear",
    )
    corner: PositiveNumber | None = Field(
        None, description=f"baseline: highpass: frequency, Hz, below which motion is taken out; default: {CORNER:g}"
    )
    pulse: Literal["half_sine", "rectangle", "sine", "dejong"] | None = Field(
        None, description="in place of a file: form of a pulse"
    )
    amplitude: BaseAcceleration | None = Field(
        None, description="pulse: greatest acceleration with its unit, `0.3 g` or `3 m/s2`; vary it by scale"
    )
    duration: Time | None = Field(None, description="pulse: t_p, s")

    @property
    def corner_or_usual(self) -> float:
        """Of the high-pass filter, Hz."""
        return CORNER if self.corner is None else self.corner


class ForceHistorySection(OverTime):
    """A force over time, on one block."""

    file: str = Field(min_length=1, description=FILE)
    on: Selector = Field(description="the block")
    at: Point | None = Field(None, description="point of application as built; default: the centroid")
    unit: UnitOfForce = Field(description="unit of the values of the file: N, kN or another")
    direction: Along = Field(description="of a positive force: x, y, z, -x, -y, -z or a vector of any length")


def vector_of(along: str | tuple[float, ...]) -> tuple[float, ...]:
    """The direction that a deck gives by its axis, or as a vector."""
    if not isinstance(along, str):
        return along
    sign = -1.0 if along.startswith("-") else 1.0
    return tuple(sign if axis == along[-1] else 0.0 for axis in AXES)


def is_at2(file: str) -> bool:
    """Whether a file is a record as PEER writes it, by its name."""
    return file.lower().endswith((".at2", ".vt2", ".dt2"))


@rule(MotionSection)
def record_or_pulse(motion: MotionSection) -> Iterator[Finding]:
    """What goes with a record, what with a pulse."""
    if len(given(motion, ("file", "pulse"))) != 1:
        return
    own, other = (RECORD_KEYS, PULSE_KEYS) if motion.pulse is None else (PULSE_KEYS, RECORD_KEYS)
    kind = "pulse" if motion.pulse is None else "file"
    for key in other:
        if key in motion.model_fields_set:
            yield Finding("key-of-another-choice", f"applies with {kind} only", key)
    if motion.pulse is not None:
        for key in own:
            if getattr(motion, key) is None:
                words = {
                    "amplitude": 'its greatest acceleration with a unit, such as "0.3 g"',
                    "duration": "in seconds",
                }
                yield Finding("missing-key", f"needs {key}, {words[key]}")
    elif motion.unit is None:
        yield Finding("missing-key", "needs unit, that of the values of the file: g, m/s2 or cm/s2")
    if motion.corner is not None and motion.baseline != "highpass" and motion.pulse is None:
        yield Finding("key-of-another-choice", "applies with baseline: highpass only", "corner")


@rule(MotionSection)
def directions_of_motion(motion: MotionSection) -> Iterator[Finding]:
    """One direction, or one for each column of values."""
    if motion.count < 2:
        if motion.directions is not None:
            yield Finding("key-of-another-choice", "applies to several columns of values: use direction", "directions")
        elif motion.direction is None and given(motion, ("file", "pulse")):
            yield Finding("missing-key", "needs direction, along which the base is accelerated: x, y, z or a vector")
        return
    if motion.direction is not None:
        words = "applies to one column of values: use directions, or leave it out for x, y, z"
        yield Finding("key-of-another-choice", words, "direction")
    if motion.directions is not None and len(motion.directions) != motion.count:
        words = f"needs {motion.count} items, one for each column of values, has {len(motion.directions)}"
        yield Finding("wrong-length", words, "directions")


@rule(MotionSection, ForceHistorySection)
def columns_of_a_file(section: MotionSection | ForceHistorySection) -> Iterator[Finding]:
    """Each column once, and values among them; a record of PEER has none."""
    columns = section.columns or []
    for key in given(section, ("columns", "interval")) if section.file and is_at2(section.file) else ():
        yield Finding("key-of-another-choice", "does not apply to a file AT2, which says itself what it has", key)
    if not 1 <= section.count <= 3:
        words = "needs a column of values after that of the times; of a file without times give interval"
        few = section.count < 1
        yield Finding("wrong-length", words if few else "needs 3 items at most, has 4: an axis for each", "columns")
    for number, column in enumerate(columns):
        if column in columns[:number]:
            yield Finding("duplicate-key", f"{column} is listed already", "columns", number)


@rule(ForceHistorySection)
def one_column_of_force(section: ForceHistorySection) -> Iterator[Finding]:
    """A force has one direction."""
    if section.count > 1:
        words = f"has {section.count} columns of values: make one entry for each direction"
        yield Finding("wrong-length", words, "columns")
