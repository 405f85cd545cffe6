"""Ties: where they are, what they may bear, what they do at collapse."""

from __future__ import annotations

from collections.abc import Sequence

from mbla.model.ties.ties import Ties
from mbla.results.collapse.ties import TieRow, tie_rows
from mbla.results.quantities.group import Field, Group
from mbla.results.record.scene import Scene

MODEL = Group[Ties](lambda scene: scene.model.ties if len(scene.model.ties) else None, file="model", part="ties")
MODEL.fields(
    Ties,
    tie_names=Field("names of ties", "tie", attribute="names"),
    tie_forms=Field("tie, strut, bar, ring, strip, fill or cohesion (of fill)", "tie", attribute="forms"),
    tie_closed=Field("1 where the last point is joined to the first one", "tie", attribute="closed"),
    tie_start=Field("first point of each", "tie_bound", rule="start of tie_point", attribute="start"),
    tie_bodies=Field("block at each point; -1: held outside of the model", "tie_point", attribute="bodies"),
    tie_places=Field("where it is", "tie_point axis", unit="length", attribute="places"),
    tie_pulls=Field("force on the block there for a tension of 1", "tie_point axis", attribute="pulls"),
    tie_least=Field("least force, tension positive", "tie", unit="force", attribute="least"),
    tie_greatest=Field("greatest force", "tie", unit="force", attribute="greatest"),
    tie_prestress=Field("force when it was fitted", "tie", unit="force", attribute="prestress"),
    tie_breaks_at=Field(
        "elongation over length at which it breaks, inf: it does not", "tie", rule="open", attribute="breaks_at"
    ),
)


def _rows(scene: Scene) -> Sequence[TieRow]:
    """Of a load case with forces, in the order of the deck."""
    return () if scene.mechanics is None else tie_rows(scene.model, scene.mechanics)


TIES = Group[Sequence[TieRow]](_rows, files="table", table="ties", rows="")
TIES.fields(
    TieRow,
    name=Field("name of the tie"),
    form=Field("tie, strut, bar, ring, strip, fill or cohesion (of fill)"),
    from_body=Field("block at its first point; outside: held outside of the model"),
    to_body=Field("block at its last point"),
    from_place=Field("its first point", "axis", unit="length"),
    to_place=Field("its last point", "axis", unit="length"),
    length=Field("length of its line", unit="length"),
    least=Field("least force, tension positive", unit="force"),
    greatest=Field("greatest force", rule="open", unit="force"),
    prestress=Field("force when it was fitted", unit="force"),
    force=Field("force; none: between what does not move, or without a result", rule="open", unit="force"),
    use=Field("share of the greatest force in its sense", rule="open"),
    rate=Field("elongation rate for unit power of the live load", rule="open", unit="velocity"),
    power=Field("power that it takes for unit power of the live load", rule="open"),
    state=Field("yields, slack, passive limit or active limit of fill, or empty"),
)
