"""An object of the JSON record whose values are found when somebody asks for them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any


class OnDemand(Mapping[str, Any]):
    """Keys are known, each value is worked out at its first use and kept."""

    def __init__(self, makers: Mapping[str, Callable[[], Any]]) -> None:
        self._makers = dict(makers)
        self._found: dict[str, Any] = {}

    def __getitem__(self, key: str) -> Any:
        """The value; KeyError where there is no such key."""
        if key not in self._found:
            self._found[key] = self._makers[key]()
        return self._found[key]

    def __contains__(self, key: object) -> bool:
        return key in self._makers

    def __iter__(self) -> Iterator[str]:
        return iter(self._makers)

    def __len__(self) -> int:
        return len(self._makers)
