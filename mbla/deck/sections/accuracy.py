"""What the word ``analysis.accuracy`` sets: the knobs of speed against accuracy, and the value of each by preset.

A knob that the deck gives wins. What a preset turns was measured knob by knob (decks/tradeoff/README.md);
what it leaves alone costs little or changes the structure that is analysed:

- a looser solver saves nothing. Of the 10 to 50 iterations of a program the tolerance 1e-4 spares the last two to
  eight, and the repair of the rougher answer to proved bounds takes as long again: with 1e-8 a draft mostly proves its
  load factor of associative flow to 1e-5, as every other answer that is called solved;
- the proof of that load factor takes 3 to 15 % of an associative run, and is never left out; nor is the program that
  shows that the dead load is carried, without which a load factor means nothing;
- standing is an answer in addition to the load factor, which it does not change. A draft goes without, save where flow
  is not associative: what stands by self-stress only has no collapse load;
- without dilatancy a draft looks for no state of a lower load factor than the one that the loading leads to, and in
  space follows no second path with torsion of uniform pressure;
- ``reference`` alone follows paths of joints of other stiffnesses beside that of the deck: what the load factor
  without dilatancy hangs on;
- flow rule, contact points or resultants are the engineer's choice. They move the load factor by up
  to tens of per cent, and no preset touches them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Literal, TypeAlias, get_args

if TYPE_CHECKING:
    from mbla.deck.sections.analysis import AnalysisSection

Accuracy: TypeAlias = Literal["draft", "standard", "reference"]


@dataclass(frozen=True)
class Knobs:
    """Everything that trades speed for accuracy; a field for each key of the analysis section of that name.

    tolerance : of the cone solver, relative
    gap       : wanted distance of the proved bounds of an associative load factor, relative; a program whose bounds lie
                further apart is solved again
    residual  : wanted of flow without normality: largest residual at which a search has found a state
    search    : flow without normality: iterations spent on lower load factors, over those of the first state found
    torsion   : in space without dilatancy: whether a second path tells the load factor with torsion of uniform pressure
    standing  : whether it is assessed that the structure stands under its dead load
    """

    tolerance: float
    gap: float
    residual: float
    search: float
    torsion: bool
    standing: bool


PRESETS: Mapping[Accuracy, Knobs] = {
    "draft": Knobs(tolerance=1e-8, gap=1e-3, residual=5e-3, search=0.0, torsion=False, standing=False),
    "standard": Knobs(tolerance=1e-9, gap=3e-7, residual=1e-6, search=1.0, torsion=True, standing=True),
    "reference": Knobs(tolerance=1e-10, gap=5e-8, residual=1e-9, search=4.0, torsion=True, standing=True),
}
"""By the deck's word."""


def knobs_of(analysis: AnalysisSection) -> Knobs:
    """The knobs in effect: those given in the deck, the others as ``accuracy`` sets them.

    Where flow is not associative the standing is assessed whatever the preset: a claim depends on it.
    """
    preset = PRESETS[analysis.accuracy]
    values = {field.name: getattr(analysis, field.name) for field in fields(Knobs)}
    values = {name: getattr(preset, name) if value is None else value for name, value in values.items()}
    if analysis.standing is None and analysis.flow_rule != "associative":
        values["standing"] = True
    return Knobs(**values)


def set_by_accuracy(knob: str) -> str:
    """For the description of a key: what each preset sets it to."""
    values = ", ".join(f"{name} {_in_words(getattr(PRESETS[name], knob))}" for name in get_args(Accuracy))
    return f"default by accuracy: {values}"


def _in_words(value: float | bool) -> str:
    return str(value).lower() if isinstance(value, bool) else f"{value:g}"
