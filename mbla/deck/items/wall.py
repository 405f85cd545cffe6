"""Item `wall`."""

from __future__ import annotations

from pydantic import Field

from mbla.deck.items.masonry import Buttress, Gable, Masonry, Opening
from mbla.deck.quantities import PositiveLength


class WallItem(Masonry):
    """A straight wall: runs along +x from the origin, rises along +z, thickness along +y."""

    length: PositiveLength = Field(description="length of the wall; the closing units are cut to fit")
    openings: list[Opening] = Field(default_factory=list, description="rectangles left free")
    gable: Gable | None = Field(None, description="triangle on top")
    buttresses: list[Buttress] = Field(default_factory=list, description="piers against its faces")
