"""An interruption while the types of the deck are built is an interruption, not a fault of the types."""

from __future__ import annotations

import signal
from typing import Any

import pytest

from mbla.deck.section import Section, built


def test_a_signal_waits_until_the_validator_is_there() -> None:
    class Struck(str):
        @classmethod
        def __get_pydantic_core_schema__(cls, source: Any, handler: Any) -> Any:
            signal.raise_signal(signal.SIGINT)
            return handler(str)

    class Stone(Section):
        name: Struck

    with pytest.raises(KeyboardInterrupt):
        built(Stone)
    assert built(Stone).model_validate({"name": "ashlar"}).name == "ashlar"
