"""Kinds of items of `blocks`: a file each, with type, rules, geometry and facts, that registers its kind at its foot.

Whoever asks for one of them gets all: every file of this folder is imported with it. What kinds share is in ``item``,
``generated`` and in folders; of folders, what makes the geometry of few kinds is imported when a deck has
one of them.
"""

from importlib import import_module
from pkgutil import iter_modules

from mbla.model.blocks.item import ITEM_KINDS as ITEM_KINDS

for _file in iter_modules(__path__):
    import_module(f"{__name__}.{_file.name}")
