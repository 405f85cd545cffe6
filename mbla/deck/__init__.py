"""The deck: text of an analysis to checked content, with the place of every value for messages.

::

    bytes ──> text ──> tree ──────> + included ──> + overrides ──> DeckContent ──> Deck
    sources   reader   data, marks  include        overrides       validation      reading
              scalars  tree                                        types, rules,
                                                                   references, units, expressions
"""

from mbla.deck.deck import Deck, Source, read_deck, read_deck_text

__all__ = ["Deck", "Source", "read_deck", "read_deck_text"]
