"""Key `objective` of a load case: a force, whose least and greatest value take the place of a load factor."""

from __future__ import annotations

from collections.abc import Iterator

from pydantic import ConfigDict, Field

from mbla.deck.quantities import Direction, Index, Name
from mbla.deck.section import Section, exactly_one_of, given, rule
from mbla.deck.sections.selectors import Selector
from mbla.errors import Finding

SIDES = ("from_", "on")
"""Fields of the two sides of a cut, of which at least one is given."""


class ForceSection(Section):
    """The force of some bodies on others along a direction, through all joints between them, without ties."""

    model_config = ConfigDict(json_schema_extra={"anyOf": [{"required": ["from"]}, {"required": ["on"]}]})

    from_: Selector | None = Field(
        None, alias="from", description="blocks that exert the force, free or fixed; default: ground and fixed blocks"
    )
    on: Selector | None = Field(None, description="blocks on which the force acts; default: all other blocks")
    direction: Direction = Field(description="along which it is measured; a force the other way is negative")


@exactly_one_of("force", "tie")
class ObjectiveSection(Section):
    """The force, least and greatest over all forces in the joints that balance the loads within their strengths."""

    force: ForceSection | None = Field(
        None, description="the force through a cut: the reaction of a support, the thrust in a joint of an arch"
    )
    tie: Name | None = Field(
        None,
        description="name of ties in `ties`, or their form: the force of the tie, tension positive; of several "
        "ties the sum",
    )
    index: Index | None = Field(None, description="number among the ties of that name, from 0 as in results")


@rule(ObjectiveSection)
def objective(section: ObjectiveSection) -> Iterator[Finding]:
    """An index counts among ties."""
    if section.index is not None and section.tie is None:
        yield Finding("key-of-another-choice", "applies with tie only", "index")


@rule(ForceSection)
def force(section: ForceSection) -> Iterator[Finding]:
    """A force has a side that is named."""
    if not given(section, SIDES):
        yield Finding("missing-key", "needs one of from or on")
