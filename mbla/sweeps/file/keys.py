"""Key paths that the parameters of a sweep set in the deck."""

from __future__ import annotations

from mbla.sweeps.file.content import Parameter


def key_paths(name: str, parameter: Parameter) -> tuple[str, ...]:
    """Key paths of a parameter: those that it gives, or what its name stands for."""
    if parameter.key is None:
        return (name if "." in name else f"parameters.{name}",)
    return (parameter.key,) if isinstance(parameter.key, str) else tuple(parameter.key)


def spelt(key: str) -> tuple[str, ...]:
    """Parts of a key path, numbers of items in one spelling: ``blocks.00.box`` is ``blocks.0.box``."""
    return tuple(str(int(part)) if part.isascii() and part.isdecimal() else part for part in key.strip().split("."))
