"""The model stage: from a checked deck to blocks, supports and loads as arrays.

Kinds of items and loads are at home in it, and the deck's types are made of these: the deck is complete before anything
here is imported, and the stage itself is imported when first asked for.
"""

from typing import TYPE_CHECKING

import mbla.deck  # noqa: F401  it lists the kinds of this stage, so that it comes first

if TYPE_CHECKING:
    from mbla.model.build import build_model as build_model
    from mbla.model.model import Model as Model

_HOMES = {"Model": "mbla.model.model", "build_model": "mbla.model.build"}
__all__ = ["Model", "build_model"]


if not TYPE_CHECKING:  # a checker knows the names above, and only these

    def __getattr__(name: str) -> object:
        if name not in _HOMES:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        from importlib import import_module

        return getattr(import_module(_HOMES[name]), name)
