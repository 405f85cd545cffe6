"""mbla: limit analysis of masonry as an assembly of rigid blocks.

The program on one line; each word is a folder, and its main type carries the folder's name::

    deck ──> model ──> contacts ──> program ──> solution ──> results
    text     blocks,    interfaces,  equilibrium,  load factor,  .h5 .vtu
             supports,  contact      yield cones,  forces,       listing,
             loads      points       objective     mechanism     pictures

A stage imports only from the stages to its left; ``run_deck.py`` is the table of contents.
"""

__version__ = "0.1.0"
