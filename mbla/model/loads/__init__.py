"""Loads as forces and moments on blocks, about their centroids: one kind a file, which registers it at its foot.

All files of this folder are imported here, so that a new kind is a file and nothing else.
"""

from importlib import import_module
from pkgutil import iter_modules

for _file in iter_modules(__path__):
    import_module(f"{__name__}.{_file.name}")
