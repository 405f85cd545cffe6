"""Section `blocks`: items, of the kinds that the files of ``mbla.model.blocks`` register."""

from __future__ import annotations

from mbla.deck.kinds.kinds import Choice, keys_of
from mbla.deck.section import exactly_one_of
from mbla.model.blocks import ITEM_KINDS as ITEM_KINDS
from mbla.model.blocks.item import AnyItem, ItemKind


@exactly_one_of()
@keys_of(ITEM_KINDS)
class BlockItem(Choice):
    """An item of `blocks`: exactly one key, its kind."""

    @property
    def item(self) -> AnyItem:
        """What stands at its key."""
        item: AnyItem = self.chosen
        return item

    @property
    def facts(self) -> ItemKind:
        """What is known of its kind."""
        return ITEM_KINDS[self.kind]
