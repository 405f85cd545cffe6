"""Random small decks, and the slopes of their load factors by differences of full solutions."""

from __future__ import annotations

from dataclasses import dataclass
from random import Random

from mbla.solution.further.sensitivity.slopes import Slope
from mbla.solution.solution import Status
from tests.line import case_of

STEP = 1e-3
"""of a parameter, relative: load factors are good to 1e-10, slopes by differences of second order to 1e-6 or so"""

DECK = """\
mbla: 1
parameters: {{mu: {mu}, c: {c}, fc: {fc}, t: {t}, s: {s}}}
materials: {{stone: {{density: 2000}}, brick: {{unit_weight: 15000}}}}
joints:
  dry: {{friction: "=mu"}}
  mortar: {{friction: 0.7, cohesion: "=c", tensile_strength: "=0.4*c"{crush}}}
blocks:
{blocks}
contacts: {{joint: {joint}, overrides: [{{between: [{group}, ground], joint: {ground}}}]}}
supports: [{{ground: {{z: 0}}}}]
load_cases:
  push: {{live: [{live}]}}
analysis: {{flow_rule: associative, accuracy: reference, sensitivity: [{keys}]}}
"""


def random_text(seed: int) -> str:
    """A deck; the same for the same seed."""
    rng = Random(seed)
    group = rng.choice(["wall", "arch", "steps"])
    t = round(rng.uniform(0.25, 0.6), 3)
    if group == "wall":
        top = f"{rng.uniform(0.1, 0.3):.3f}"
        blocks = '  - wall: {material: stone, group: wall, unit: [0.4, "=t", 0.175], length: 1.6, courses: 4}\n'
        blocks += (
            f'  - box: {{material: brick, group: top, min: [0.3, 0, 0.7], max: ["=0.9+s", "=t", {0.7 + float(top)}]}}'
        )
    elif group == "arch":
        blocks = (
            '  - arch: {material: stone, group: arch, shape: semicircular, span: "=4+s", thickness: "=t", width: 0.5, '
            f"voussoirs: {rng.choice([7, 10, 11])}, springers: ground}}"
        )
    else:
        blocks = '  - box: {material: stone, group: steps, min: [0, 0, 0], max: ["=1+s", 1, "=2*t"]}\n'
        blocks += '  - box: {material: brick, group: steps, min: [0.1, 0, "=2*t"], max: ["=0.8-s", 1, "=5*t"]}'
    angle = rng.choice([(1, 0, 0), (-1, 0, 0), (0.8, 0.6, 0), (0, 1, 0)])
    live = f"{{acceleration: {list(angle)}}}"
    if rng.random() < 0.3:
        live += f", {{force: [500, 0, {rng.choice([0, -2000])}], on: {{group: {group}, index: 1}}}}"
    crush = ', compressive_strength: "=fc"' if rng.random() < 0.3 else ""
    keys = ["parameters.mu", "parameters.t", "parameters.s", "materials.stone.density", "materials.brick.unit_weight"]
    joint, ground = rng.choice(["dry", "mortar"]), rng.choice(["dry", "mortar"])
    if "mortar" in (joint, ground):
        keys += ["parameters.c", "joints.mortar.friction", "joints.mortar.cohesion"]
        keys += ["parameters.fc"] if crush else []
    return DECK.format(
        mu=round(rng.uniform(0.3, 0.9), 3),
        c=round(rng.uniform(500, 5000), 1),
        fc=round(rng.uniform(1e5, 1e6)),
        t=t,
        s=round(rng.uniform(0.05, 0.2), 4),
        crush=crush,
        blocks=blocks,
        group=group,
        joint=joint,
        ground=ground,
        live=live,
        keys=", ".join(keys),
    )


@dataclass(frozen=True)
class Differences:
    """Slopes below and above a value by differences of load factors, of second order."""

    below: float
    above: float


def differences(text: str, slope: Slope, factor: float, relative: float = STEP) -> Differences | None:
    """By steps ``relative`` to the value; None where a solution nearby is not solved."""
    step, found = relative * slope.value, {0: factor}
    for row in (-2, -1, 1, 2):
        _, case = case_of(text, f"{slope.parameter}={slope.value + row * step!r}", "analysis.sensitivity=false")
        if case.status is not Status.SOLVED or case.solution.mechanics is None:
            return None
        found[row] = case.solution.mechanics.load_factor
    sides = [sign * (-3 * found[0] + 4 * found[sign] - found[2 * sign]) / (2 * step) for sign in (-1, 1)]
    return Differences(*sides)


TIED = """\
mbla: 1
parameters: {{{values}}}
materials: {{stone: {{density: 2000}}}}
joints: {{dry: {{friction: {mu}{crush}}}}}
blocks:
  - wall: {{material: stone, group: wall, unit: [0.4, 0.3, 0.2], length: 1.6, courses: 5}}
  - box: {{material: stone, group: cap, min: [0, 0, 1], max: [1.6, 0.3, 1.3]}}
contacts: {{joint: dry}}
supports: [{{ground: {{z: 0}}}}]
ties:
{ties}
load_cases:
  push: {{live: [{{acceleration: {way}}}]}}
analysis: {{flow_rule: associative, accuracy: reference, sensitivity: true}}
"""


def tied_text(seed: int) -> str:
    """A wall with ties of all kinds; the parameters s0, s1, ... are a strength of each."""
    rng, ties = Random(seed), list[str]()

    def within(low: float, high: float) -> float:
        return round(rng.uniform(low, high), 3)

    for number in range(rng.choice([1, 2, 3])):
        forms = ('capacity: "={}"', 'area: 1e-5, strength: "=1e5*{}"', 'diameter: 0.01, strength: "=1e4*{}"')
        keys = rng.choice(forms).format(f"s{number}")
        side, z = rng.choice([-1, 1]), within(1.03, 1.27)
        end, away = (0.0, -within(0.5, 3)) if side < 0 else (1.6, 1.6 + within(0.5, 3))
        to_ground = f"through: [[{end}, 0.15, {z}], [{away}, 0.15, {within(0, 2)}]], on: [cap, ground]"
        kinds = {
            "rod": to_ground,
            "prestressed": f"{to_ground}, prestress: 1",
            "strut": f"{to_ground}, acts: compression",
            "bar": f"{to_ground}, acts: both",
            "passes": f"through: [[{within(0.05, 0.3)}, 0, 1.1], [{within(0.5, 0.7)}, 0, 0.5], [3, 0, {z}]], "
            "on: [cap, wall, ground]",
            "fixed": f"through: [[{within(0.05, 0.3)}, 0, 1.1], [{within(0.5, 0.7)}, 0, 0.5], [3, 0, {z}]], "
            f"on: [cap, wall, ground], points: fixed, acts: {rng.choice(['tension', 'both'])}",
            "strip": f"strip: [[{within(0.2, 0.3)}, 0, 0.03], [{within(0.5, 0.55)}, 0, {z}]]",
            "repeated": f"{to_ground}, acts: both, repeat: [{{count: 2, translate: [0, 0.05, 0]}}]",
        }  # fmt: skip
        kind = rng.choice(sorted(kinds))
        ties.append(f"  - {{name: t{number}, {kinds[kind]}, {keys}}}")
    return TIED.format(
        values=", ".join(f"s{number}: {within(50, 800)}" for number in range(len(ties))),
        mu=within(0.3, 0.9),
        crush=rng.choice(["", ", compressive_strength: 4e5"]),
        ties="\n".join(ties),
        way=rng.choice([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0.8, 0.6, 0]]),
    )
