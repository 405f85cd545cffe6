"""Fields of records that stand in a group of a result file."""

from __future__ import annotations

from typing import Any

from mbla.results.quantities.registry import held as fields_held


def held(kind: type, group: str, get: dict[str, Any]) -> dict[str, Any]:
    """Fields of a dataclass that stand in a group of a load case, those that are there."""
    prefix = f"{group}/" if group else ""
    names = fields_held(kind, f"cases/*/{group}".removesuffix("/"))
    return {field: get[prefix + name] for field, name in names.items() if prefix + name in get}
