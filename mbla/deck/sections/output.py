"""Sections `output` and `expected`: which files are written, and what the results should be."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from mbla.deck.quantities import Count, Integer, Line, Number, PositiveNumber, Switch
from mbla.deck.section import Section, given, rule
from mbla.errors import Finding


class OutputSection(Section):
    """Which result files are written."""

    vtu: Switch = Field(True, description="VTU and PVD files for ParaView")
    frames: Annotated[int, Integer(ge=2, le=1000)] = Field(11, description="frames of the animation of the mechanism")
    plots: Switch = Field(
        False, description="pictures of model, mechanisms and forces beside the results, as of ``mbla plot``"
    )
    positions: Literal["worst", "all"] = Field(
        "worst", description="positions of a travelling load that have files, pictures and a section of the listing"
    )


class Expectation(Section):
    """What a load case should give, with its source."""

    load_factor: Number | None = Field(None, description="by the deck's own flow rule")
    angle: Number | None = Field(None, description="tilt: angle of collapse in degrees")
    position: Count | None = Field(None, description="travel: number of the worst position, from 1")
    associative_load_factor: Number | None = Field(None, description="by the associative flow rule")
    reaction: Number | None = Field(None, description="of the support that gives way")
    lower: Number | None = Field(None, description="least load factor for the mechanism found, without normality")
    status: Literal["solved", "approximate", "not_verified", "no_equilibrium", "unbounded"] | None = Field(
        None, description="status of the case"
    )
    tolerance: PositiveNumber = Field(1e-5, description="relative difference that is allowed")
    source: Line = Field(min_length=1, description="where the figure is from")


FIGURES = ("load_factor", "angle", "position", "associative_load_factor", "reaction", "lower", "status")


@rule(Expectation)
def expectation(item: Expectation) -> Iterator[Finding]:
    """Something must be expected."""
    if not given(item, FIGURES):
        yield Finding("missing-key", f"needs at least one of {', '.join(FIGURES[:-1])} or {FIGURES[-1]}")
