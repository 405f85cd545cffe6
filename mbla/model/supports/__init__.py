"""Supports: one kind per file; ``build`` makes those of a deck."""

from mbla.model.supports.build import Supports, build_supports, does_nothing

__all__ = ["Supports", "build_supports", "does_nothing"]
