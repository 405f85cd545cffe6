"""Sections `loads` and `masses`, and the loads of `load_cases`."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, TypeAlias

from pydantic import Field, create_model

import mbla.model.loads  # noqa: F401 - every file of it registers a kind
from mbla.deck.kinds.kinds import in_order
from mbla.deck.kinds.load_key import LOAD_KEYS as LOAD_KEYS
from mbla.deck.kinds.load_key import NAMED, LoadKey, live_only, loads_that, loads_that_take, register_load
from mbla.deck.quantities import Name, Point, PositiveMass
from mbla.deck.section import Section, exactly_one_of, rule
from mbla.deck.sections.any_load import AnyLoad
from mbla.deck.sections.selectors import Selector
from mbla.deck.suggestions import listed
from mbla.errors import Finding

register_load(
    LoadKey(
        name=NAMED,
        section=Name,
        description="the loads of that name in section loads, all of them",
        after="vehicle",
        refuses={"on": "named loads: each of them says itself on which blocks it acts"},
    )
)


NO_KIND = LoadKey(name="", section=None, description="")
"""of a load without one, which is refused as such"""


def complete_load() -> type[AnyLoad]:
    """The type of a load with the keys of all kinds, of which it has exactly one."""
    kinds: dict[str, Any] = {
        kind.name: (kind.section | None, Field(None, description=kind.description)) for kind in in_order(LOAD_KEYS)
    }
    shared: dict[str, Any] = {
        key: (AnyLoad.model_fields[key].annotation, Field(AnyLoad.model_fields[key].default, description=words))
        for key, words in _shared_in_words().items()
    }
    said = listed((f"`{key}`" for key in live_only()), "and")
    words = f"One load of exactly one kind; dead or live, save {said}, which are live only."
    make: Any = create_model  # its types are those of fields that are known
    load: type[AnyLoad] = make(
        "Load", __base__=(AnyLoad, make("KindKeys", __base__=Section, **kinds)), __doc__=words, **shared
    )
    sums = loads_that(lambda kind: kind.name != NAMED and not kind.live_only)
    return exactly_one_of(*sums, NAMED, *live_only())(load)


def _shared_in_words() -> dict[str, str]:
    """What keys mean that go with some kinds only."""
    of_one = ", ".join(loads_that(lambda kind: kind.needs_block))
    on_fill, patterned = (", ".join(loads_that_take(key)) for key in ("through", "pattern"))
    return {
        "on": f"{of_one}: the block; other kinds: the only blocks that they may act on; default: all",
        "through": f"{on_fill}: the fill on which they stand, straight over or under where they are drawn, and in "
        "which they spread; their forces are vertical",
        "pattern": f"{patterned}: factor by height; default: 1 everywhere",
        "follows": "in a pushover: the load turns with its block, as a pressure does; else it keeps its direction. Of "
        f"{listed(loads_that_take('follows'), 'and')}",
    }


if TYPE_CHECKING:
    Load: TypeAlias = AnyLoad
else:
    Load = complete_load()


@rule(Load)
def load_keys(load: AnyLoad) -> Iterator[Finding]:
    """Where a load acts, as far as that applies."""
    kinds = [kind for kind in in_order(LOAD_KEYS) if getattr(load, kind.name) is not None] or [NO_KIND]
    kind = kinds[0]  # several are refused as such
    if kind.needs_block and load.on is None:
        yield Finding("one-block-only", f"a {kind.name} needs `on`, the block it acts on")
    if load.at is not None and "at" not in kind.takes:
        yield Finding("key-of-another-choice", f"applies to a {listed(loads_that_take('at'))} only", "at")
    for each in kinds if load.on is not None else []:
        if "on" in each.refuses:
            yield Finding("key-of-another-choice", f"does not apply to {each.refuses['on']}", "on")
    for key, has in (("pattern", load.pattern is not None), ("follows", load.follows)):
        if has and key not in kind.takes:
            yield Finding("key-of-another-choice", f"applies to {listed(loads_that_take(key))} only", key)
    if load.through is not None:
        yield from _through_fill(load, kind)
    if load.factor != 1.0 and "factor" in kind.refuses:
        yield Finding("key-of-another-choice", f"does not apply to {kind.refuses['factor']}", "factor")


def _through_fill(load: AnyLoad, kind: LoadKey) -> Iterator[Finding]:
    if "through" not in kind.takes:
        yield Finding("key-of-another-choice", f"applies to {listed(loads_that_take('through'))} only", "through")
        return
    if load.on is not None:
        yield Finding(
            "key-of-another-choice", "does not apply with through: the fill says on which blocks it lies", "on"
        )
    if load.follows:
        yield Finding("key-of-another-choice", "does not apply with through: fill does not turn with blocks", "follows")
    if "towards" in load.chosen.model_fields_set:
        words = "does not apply with through: in fill a load spreads straight down"
        yield Finding("key-of-another-choice", words, kind.name, "towards")


class AddedMass(Section):
    """A mass that blocks carry along: gravity and accelerations act on it as on the blocks."""

    mass: PositiveMass = Field(description="the mass, all together")
    on: Selector = Field(description="blocks that share it in proportion to their volumes, at their centroids")
    at: Point | None = Field(None, description="place of a mass on one block; default: the centroid of the block")
