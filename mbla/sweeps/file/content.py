"""The types of a sweep file: the one source of its schema, of the checks on single values and of its key reference.

Numbers are plain; values that go into the deck are written as the deck takes them there, with a unit or as a list.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal, TypeAlias

from pydantic import BeforeValidator, Field

from mbla.deck.content import no_boolean
from mbla.deck.quantities import NAME_PATTERN, Integer, Line, Name, Number, PositiveNumber, RealNumber, Switch, Time
from mbla.deck.section import ByShape, Section

MAX_POINTS = 1_000_000
"""points of one sweep; more would not give a readable table"""

DISTRIBUTIONS = ("normal", "lognormal", "uniform", "triangular")
"""ways of a parameter to say its values that have no levels: a grid cannot take them"""
WITH_POINTS = ("linear", "log", "horizon", "sphere")
"""they need a number of points where they are levels, and have none where they are sampled"""
DIRECTIONS = ("horizon", "sphere")
"""they turn a vector of the deck"""
WAYS = ("values", "linear", "log", "whole", *DISTRIBUTIONS, *DIRECTIONS)
RANDOM = (*DISTRIBUTIONS, "whole", *DIRECTIONS)
"""drawn values of these have a probability; those of plain ranges and lists only fill the space"""
SAMPLED = ("random", "latin_hypercube", "sobol")
"""parts of the design whose points are drawn"""

Degrees: TypeAlias = Annotated[float, RealNumber("number", ge=-360, le=360)]
Elevation: TypeAlias = Annotated[float, RealNumber("number", ge=-90, le=90)]
PointCount: TypeAlias = Annotated[int, Integer(ge=1, le=MAX_POINTS)]
Levels: TypeAlias = Annotated[int, Integer(ge=2, le=MAX_POINTS)]
LEVELS = "how many; in a design that samples the range there are none, it takes any value"
Seed: TypeAlias = Annotated[int, Integer(ge=0, le=2**32 - 1)]
VariedName: TypeAlias = Annotated[str, Field(pattern=NAME_PATTERN, max_length=200)]
"""also a key path, which may be long"""
KeyPaths: TypeAlias = Annotated[str | Annotated[list[str], Field(min_length=1)], ByShape("name")]


class LinearRange(Section):
    """Values at equal distances, both ends among them."""

    start: Number = Field(alias="from", description="first value")
    end: Number = Field(alias="to", description="last value")
    points: Levels | None = Field(None, description=LEVELS)


class LogRange(Section):
    """Values at equal ratios, both ends among them."""

    start: PositiveNumber = Field(alias="from", description="first value")
    end: PositiveNumber = Field(alias="to", description="last value")
    points: Levels | None = Field(None, description=LEVELS)


class IntegerRange(Section):
    """Integers, each of them; all equally likely where they are drawn."""

    start: Annotated[int, Integer(ge=-(2**31), le=2**31 - 1)] = Field(alias="from", description="first number")
    end: Annotated[int, Integer(ge=-(2**31), le=2**31 - 1)] = Field(alias="to", description="last number")


class Normal(Section):
    """Normal distribution, cut off where that is asked for."""

    mean: Number = Field(description="mean, before it is cut off")
    deviation: PositiveNumber = Field(description="standard deviation, before it is cut off")
    least: Number | None = Field(None, alias="min", description="least value")
    greatest: Number | None = Field(None, alias="max", description="greatest value")


class Lognormal(Section):
    """Lognormal distribution by mean and standard deviation of the value itself, not of its logarithm."""

    mean: PositiveNumber = Field(description="mean, before it is cut off")
    deviation: PositiveNumber = Field(description="standard deviation, before it is cut off")
    least: PositiveNumber | None = Field(None, alias="min", description="least value")
    greatest: PositiveNumber | None = Field(None, alias="max", description="greatest value")


class Uniform(Section):
    """Uniform distribution."""

    start: Number = Field(alias="from", description="least value")
    end: Number = Field(alias="to", description="greatest value")


class Triangular(Section):
    """Triangular distribution."""

    start: Number = Field(alias="from", description="least value")
    mode: Number = Field(description="most likely value")
    end: Number = Field(alias="to", description="greatest value")


class Horizon(Section):
    """Directions around the vertical: the horizontal part of a vector of the deck is turned, its size kept."""

    start: Degrees = Field(0.0, alias="from", description="first azimuth in degrees, from +x towards +y")
    end: Degrees = Field(360.0, alias="to", description="last azimuth; left out where it is a full circle on")
    points: PointCount | None = Field(None, description="how many; none in a design that samples directions")
    size: PositiveNumber | None = Field(
        None, description="length of the horizontal part; default: length of the vector in the base deck"
    )


class Sphere(Section):
    """Directions over a sphere, or between two elevations, of equal share of its surface."""

    start: Elevation = Field(-90.0, alias="from", description="least elevation above the horizon in degrees")
    end: Elevation = Field(90.0, alias="to", description="greatest elevation")
    points: PointCount | None = Field(
        None, description="how many, on a spiral; none in a design that samples directions"
    )
    size: PositiveNumber | None = Field(None, description="length of the vector; default: its length in the base deck")


class Parameter(Section):
    """What changes from point to point: where it goes in the deck, and exactly one of the ways to say its values."""

    key: KeyPaths | None = Field(
        None,
        description="key path in the deck, or several that get the same value; default: the name, as "
        "a parameter of the deck or, with full stops in it, a key path",
    )
    unit: Line = Field("", description="unit of the values, for tables and pictures; the deck's own is known by itself")
    values: Annotated[list[Any], Field(min_length=1)] | None = Field(
        None, description="a list: numbers, texts, truth values, or lists as the deck takes them"
    )
    linear: LinearRange | None = Field(None, description="a range in equal steps")
    log: LogRange | None = Field(None, description="a range in equal ratios")
    whole: IntegerRange | None = Field(None, description="integers, as seeds are")
    normal: Normal | None = Field(None, description="random: normal")
    lognormal: Lognormal | None = Field(None, description="random: lognormal")
    uniform: Uniform | None = Field(None, description="random: uniform")
    triangular: Triangular | None = Field(None, description="random: triangular")
    horizon: Horizon | None = Field(None, description="load directions around the horizon")
    sphere: Sphere | None = Field(None, description="load directions over a sphere")


class Combined(Section):
    """Parameters of a part of the design."""

    of: Annotated[list[str], Field(min_length=1)] | None = Field(
        None, description="parameters; default: all that no other part of the design names"
    )


class Sampled(Combined):
    """A sample of points that change several parameters together."""

    points: PointCount = Field(description="how many")
    seed: Seed = Field(1, description="another number, another sample")


class DesignPart(Section):
    """A part of the design; exactly one of its keys. Every point of it is combined with every point of the others."""

    grid: Combined | None = Field(None, description="every value of each with every value of the others")
    zip: Combined | None = Field(None, description="first with first, second with second: lists of one length")
    random: Sampled | None = Field(None, description="drawn at random, each by its distribution")
    latin_hypercube: Sampled | None = Field(None, description="each parameter's range divided evenly, one point a part")
    sobol: Sampled | None = Field(None, description="scrambled Sobol sequence; a power of two is best")


class LimitsSection(Section):
    """What one point may take; one that takes more has failed."""

    time: Time | None = Field(None, description="seconds by the clock")
    memory: Annotated[float, RealNumber("number", gt=0)] | None = Field(
        None, description="MB above what the process holds with the base deck"
    )


class SweepOutputSection(Section):
    """What is written in addition to the table."""

    files: Literal["none", "failed", "all"] = Field(
        "none", description="result files of points, as `mbla run` writes them, in points/NUMBER/"
    )
    parquet: Switch = Field(False, description="the table as Parquet too; needs mbla[tables]")
    hdf5: Switch = Field(False, description="the table as HDF5 too, along the axes of the design")


SIDES = ("demand", "limit")
"""of which a fragility has one"""
FALLS = "falls"
"""a limit that a structure in time passes where a block falls, however far it has moved"""
Limit: TypeAlias = Annotated[Literal["falls"] | Number, Field(union_mode="left_to_right")]


class FragilitySection(Section):
    """Probability that a result lies below a demand or passes a limit, from a random design or over records."""

    result: str = Field(
        "load_factor",
        description="result column; without dilatancy `least_load_factor`, named in `results`, is that to design with; "
        "of structures in time `time_history.peak` and the like",
    )
    demand: Annotated[list[Number], Field(min_length=1)] | None = Field(
        None, description="demands: the probability is that of results below them"
    )
    limit: Annotated[list[Limit], Field(min_length=1)] | None = Field(
        None,
        description="in place of demands limits: the probability is that of results that reach them, as a peak does; "
        "`falls` stands for the fall of a block, with which a structure in time passes every limit",
    )
    sample: VariedName | None = Field(
        None,
        description="parameter whose values count as a sample, each of them alike, as a list of records does; default: "
        "the random part of the design",
    )
    over: VariedName | None = Field(
        None,
        description="with limit: parameter of numbers above 0, as the scale of records, over which a lognormal curve "
        "is fitted to the shares",
    )
    confidence: Annotated[float, RealNumber("number", gt=0, lt=1)] = Field(0.95, description="of the interval")


USUAL_RESULTS = "status load_factor static_bound kinematic_bound associative_load_factor mechanism.class"


class SweepContent(Section):
    """A complete sweep file."""

    mbla_sweep: Annotated[Literal[1], BeforeValidator(no_boolean)] = Field(
        description="version of the format of sweep files"
    )
    title: Line = Field("", description="shown in tables and pictures; without one the name of the file")
    deck: str = Field(min_length=1, description="base deck, relative to this file")
    cases: Annotated[list[Name], Field(min_length=1)] | None = Field(
        None, description="load cases to solve; default: all of the deck"
    )
    set: dict[str, Any] = Field(default_factory=dict, description="values by key path of the deck, for every point")
    parameters: dict[VariedName, Parameter] = Field(min_length=1, description="what changes, by name")
    design: list[DesignPart] | None = Field(
        None, min_length=1, description="parts of the design; default: a grid of all parameters"
    )
    constraints: list[str] = Field(
        default_factory=list,
        description='comparisons such as "t < 0.2*radius"; points that break one are left out',
    )
    results: Annotated[list[str], Field(min_length=1)] = Field(
        default_factory=USUAL_RESULTS.split,
        description="columns: key paths in the JSON object of a load case, or of the run with model., settings., time.",
    )
    limits: LimitsSection = Field(default_factory=LimitsSection, description="what one point may take")
    output: SweepOutputSection = Field(
        default_factory=SweepOutputSection, description="what is written in addition to the table"
    )
    fragility: FragilitySection | None = Field(
        None, description="probability of collapse below a demand, or of passing a limit in time"
    )


# --- what a checked parameter says ------------------------------------------------------------------------------------


def way_of(parameter: Parameter) -> str:
    """The one way that a checked parameter uses."""
    return next(way for way in WAYS if getattr(parameter, way) is not None)


def level_count(parameter: Parameter) -> int | None:
    """How many values a parameter has in a grid; None where it does not say, or has no levels."""
    if parameter.values is not None:
        return len(parameter.values)
    if parameter.whole is not None:
        return parameter.whole.end - parameter.whole.start + 1
    points: int | None = getattr(getattr(parameter, way_of(parameter)), "points", None)
    return points


def key_paths(name: str, parameter: Parameter) -> tuple[str, ...]:
    """Key paths of a parameter: those that it gives, or what its name stands for."""
    if parameter.key is None:
        return (name if "." in name else f"parameters.{name}",)
    return (parameter.key,) if isinstance(parameter.key, str) else tuple(parameter.key)


def spelt(key: str) -> tuple[str, ...]:
    """Parts of a key path, numbers of items in one spelling: ``blocks.00.box`` is ``blocks.0.box``."""
    return tuple(str(int(part)) if part.isascii() and part.isdecimal() else part for part in key.strip().split("."))
