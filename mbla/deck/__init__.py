"""The deck: text of an analysis to checked content, with the place of every value for messages.

::

    bytes ──> text ──> tree ──────> + included ──> + overrides ──> DeckContent ──> Deck
    sources   reader   data, marks  include        overrides       validation      reading
              scalars  tree                                        types, rules,
                                                                   references, units, expressions

Kinds of items, in ``mbla.model.blocks``, are made of its sections: what reads a deck is imported when first asked for.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from mbla.deck.deck import Deck as Deck
    from mbla.deck.deck import Source as Source
    from mbla.deck.deck import read_deck as read_deck
    from mbla.deck.deck import read_deck_text as read_deck_text

__all__ = ["Deck", "Source", "read_deck", "read_deck_text"]


if not TYPE_CHECKING:  # a checker knows the names above, and only these

    def __getattr__(name: str) -> object:
        if name not in __all__:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        from mbla.deck import deck

        return getattr(deck, name)
