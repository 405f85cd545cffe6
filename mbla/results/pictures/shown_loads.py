"""Which loads a picture shows, with their words and colours: the same in a plane, in space and in a view to turn."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

from mbla.arrays import FloatArray
from mbla.model.model import LoadCase, Settlement
from mbla.results.pictures.load_marks import LoadMarks, load_marks
from mbla.results.pictures.page import CASES, DEAD_LOAD, LIVE_LOAD
from mbla.results.pictures.scene import Scene

MOST_CASES = 6
"""load cases whose loads a legend names"""


@dataclass(frozen=True)
class ShownLoad:
    """A load of one load case.

    text       : for the legend; empty where there are too many
    loads      : (n_blocks, 6) on blocks about their centroids
    place      : number among the loads of the picture
    settlement : shown in the place of the loads
    """

    text: str
    colour: str
    loads: FloatArray
    marks: LoadMarks
    place: int = 0
    settlement: Settlement | None = None


def shown_loads(scene: Scene, kind: str) -> list[ShownLoad]:
    """The live load of the case; of the model those of all load cases shown; the dead load where it is what acts."""
    case, found = scene.case.load_case, list[ShownLoad]()
    falls = kind == "mechanism" and scene.mechanics is None and scene.case.solution.certificate is not None
    if kind == "model" or falls:
        marks = load_marks(scene.model, scene.dead_load, case.dead_words)
        found.append(ShownLoad(_text("dead load", case.dead_words), DEAD_LOAD, scene.dead_load, marks))
    if kind != "model":
        return [*found, live_load(scene, case, "live load", LIVE_LOAD, len(found))]
    cases: dict[str, list[LoadCase]] = {}
    for each in scene.shown_cases:
        cases.setdefault(each.load_case.deck_name, []).append(each.load_case)
    for row, (name, together) in enumerate(cases.items()):
        label = f"live load {name}" if len(cases) > 1 else "live load"
        label = label if row < MOST_CASES else ""
        colour = CASES[row % len(CASES)]
        found += [live_load(scene, each, label, colour, row + 1, len(together)) for each in together]
    return found


def live_load(scene: Scene, case: LoadCase, label: str, colour: str, place: int = 0, positions: int = 1) -> ShownLoad:
    """The live load of a load case, of a vehicle its axles, or the way that a support gives.

    positions : of a travelling load that are drawn together
    """
    if case.settlement is not None:
        text = f"{label.replace('live load', '').strip()} {case.settlement.words}".strip()
        marks = load_marks(scene.model, 0 * case.live_load, ())
        return ShownLoad(text if label else "", colour, case.live_load, marks, place, case.settlement)
    many = case.travel is not None and positions > 1
    words = (f"{positions} positions",) if many else case.live_words
    marks = load_marks(scene.model, case.live_load, words, None if many else case.travel)
    return ShownLoad(_text(label, words) if label else "", colour, case.live_load, marks, place)


def _text(name: str, words: tuple[str, ...]) -> str:
    """Loads one after the other, the same words once with how often they apply."""
    told = [word if count == 1 else f"{count} times {word}" for word, count in Counter(words).items()]
    return f"{name}: {'; '.join(told)}" if told else name
