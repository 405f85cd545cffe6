"""What a check of types has found wrong so far, and the end of one that finds no end of it.

The library that checks builds an error for every wrong value, of which only the first ``MOST_FAULTS`` are told: a list
of a million wrong items would take gigabytes. An exception of ours that is no ValueError ends it at once.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from pydantic import ValidationError

from mbla.errors import MOST_FAULTS

MOST_WRONG = 20 * MOST_FAULTS
"""values that may be wrong before no more of them are looked at"""
KEY = "wrong"
"""of the context of a check, under which it has its ``WrongValues``"""


class TooManyWrongError(Exception):
    """So much is wrong that nobody corrects it fault by fault."""


@dataclass
class WrongValues:
    """Number of wrong values, and the first mappings that hold some with what is wrong in each."""

    number: int = 0
    mappings: list[tuple[dict[str, Any], ValidationError]] = field(default_factory=list)

    def add(self, number: int = 1) -> None:
        """Count wrong values.

        Raises
        ------
        TooManyWrongError
            for more than ``MOST_WRONG``
        """
        self.number += number
        if self.number > MOST_WRONG:
            raise TooManyWrongError

    def add_section(self, value: Any, error: ValidationError, before: int) -> None:
        """Count what is wrong in a section beside what was counted in it; ``before`` is the number at its beginning."""
        if isinstance(value, dict) and len(self.mappings) <= MOST_FAULTS:
            self.mappings.append((value, error))
        self.add(max(error.error_count() - (self.number - before), 0))


def wrong_values(context: dict[str, Any] | None) -> WrongValues:
    """Those of a check by its context; new ones where it does not count."""
    found = (context or {}).get(KEY)
    return found if isinstance(found, WrongValues) else WrongValues()
