"""Item `wall`."""

from __future__ import annotations

from collections.abc import Iterator

from pydantic import Field

from mbla.deck.items.masonry import Buttress, Gable, Masonry, Opening, check_buttress, check_gable, check_opening
from mbla.deck.quantities import PositiveLength
from mbla.deck.section import rule
from mbla.errors import Finding


class WallItem(Masonry):
    """A straight wall: runs along +x from the origin, rises along +z, thickness along +y."""

    length: PositiveLength = Field(description="length of the wall; the closing units are cut to fit")
    openings: list[Opening] = Field(default_factory=list, description="rectangles left free")
    gable: Gable | None = Field(None, description="triangle on top")
    buttresses: list[Buttress] = Field(default_factory=list, description="piers against its faces")


@rule(WallItem)
def wall(item: WallItem) -> Iterator[Finding]:
    """All that a straight wall has."""
    for number, opening in enumerate(item.openings):
        yield from (finding.below("openings", number) for finding in check_opening(item, opening, item.length))
    if item.gable is not None:
        yield from (finding.below("gable") for finding in check_gable(item, item.gable, item.length))
    for number, buttress in enumerate(item.buttresses):
        found = check_buttress(item, buttress, item.length)
        yield from (finding.below("buttresses", number) for finding in found)
