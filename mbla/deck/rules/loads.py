"""Rules on loads."""

from __future__ import annotations

from collections.abc import Iterator

from mbla.deck import types
from mbla.deck.rules.common import given, is_zero
from mbla.deck.rules.exactly_one import EXACTLY_ONE
from mbla.deck.section import Finding, rule


@rule(types.Load)
def load_keys(load: types.Load) -> Iterator[Finding]:
    """Where a load acts, as far as that applies."""
    if load.force is not None and load.on is None:
        yield (), "a force needs `on`, the block it acts on"
    if load.at is not None and load.force is None:
        yield ("at",), "applies to a force only"
    if load.on is not None and load.table is not None:
        yield ("on",), "does not apply to a table, whose rows name their blocks"
    if load.on is not None and load.gravity is not None:
        yield ("on",), "does not apply to gravity, which acts on all blocks: use acceleration"


@rule(types.LoadCaseSection)
def live_load_effect(case: types.LoadCaseSection) -> Iterator[Finding]:
    """A live load must do something."""
    for number, load in enumerate(case.live or ()):
        for key in given(load, EXACTLY_ONE[types.Load]):
            if is_zero(getattr(load, key)):
                yield ("live", number, key), "is a live load with no effect"


@rule(types.SettlementSection)
def settlement_direction(settlement: types.SettlementSection) -> Iterator[Finding]:
    """A settlement goes somewhere."""
    if settlement.direction is not None and is_zero(settlement.direction):
        yield ("direction",), "must not be the zero vector"
