"""Least thickness of the semicircular arch with friction (Cocchetti and Rizzi 2020, Tables 1 and 3), by ``mbla find``.

The radial joints of the model lie at whole multiples of pi/n, those of the continuous arch anywhere: the model stands
a little thinner. It comes close where a joint happens to lie near those of the true mechanism, so each friction has its
own number of voussoirs here.
"""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import pytest

from mbla.deck import read_deck_text
from mbla.solution.solution import Status
from mbla.sweeps.find.study import find
from tests.analytic.planar import arch_load_factor, centre_line_arch
from tests.line import HEAD, line_of, verified

pytestmark = pytest.mark.long

PUBLISHED = {0.7: 0.107426, 0.395832: 0.107426, 0.38: 0.122192, 0.35: 0.152920, 0.31: 0.199653}
"""Least thickness over mean radius by friction coefficient, six digits."""

VOUSSOIRS = {0.7: 86, 0.395832: 86, 0.38: 106, 0.35: 96, 0.31: 86}
FALLS = -1.0
BOUNDS, MOST_SOLVES = (0.09, 0.25), 8
NEAR = 1e-4
LONG = 720
"""At this number the joints are a quarter of a degree apart; at the limit a gravity step may not tell (exit 4)."""


def deck_text(thickness: float, voussoirs: int, mu: float) -> str:
    """Arch of mean radius 1, unit weight on each voussoir at the centroid of its arc."""
    loads = {"dead": "[0, 0, -1]", "live": "[1, 0, 0]"}
    points = [f'["=x-r*cos({i + 0.5}*d)", 0.25, "=r*sin({i + 0.5}*d)"]' for i in range(voussoirs)]
    lines = [
        HEAD,
        f'parameters: {{t: {thickness!r}, d: "=180/{voussoirs}", r: "=sin(d/2)/(d*pi/360)", x: "=1-t/2"}}',
        f"joints: {{dry: {{friction: {mu!r}}}}}",
        "blocks:",
        '  - arch: {material: stone, shape: semicircular, span: "=2*x", thickness: "=t", width: 0.5,',
        f"           voussoirs: {voussoirs}, springers: ground}}",
        "analysis: {flow_rule: associative, accuracy: reference}",
        "load_cases:",
        "  push:",
    ]
    for kind, force in loads.items():
        lines.append(f"    {kind}:")
        lines += ["      - {gravity: none}"] if kind == "dead" else []
        lines += [
            f"      - {{force: {force}, on: {{group: arch, index: {i}}}, at: {point}}}"
            for i, point in enumerate(points)
        ]
    return "\n".join(lines) + "\n"


def margin(thickness: float, voussoirs: int, mu: float) -> float:
    """Load factor of the push; negative where the arch falls by its own weight (its size means nothing then)."""
    solution, _, status = verified(line_of(deck_text(thickness, voussoirs, mu)))
    if status is Status.NO_EQUILIBRIUM:
        return FALLS
    assert solution.mechanics is not None, solution.reason
    return solution.mechanics.load_factor


def least_thickness(voussoirs: int, mu: float, exits: tuple[int, ...] = (0,)) -> float:
    """Thickness at which the arch just stands; in few solves, the last of them verified."""
    deck = read_deck_text(deck_text(0.2, voussoirs, mu), Path("arch.yaml"))
    asked = {"parameter": "parameters.t", "target": ("stands", 0.0), "bounds": BOUNDS}
    found = find(deck, SimpleNamespace(**asked, case=None, scan=None, first=None, tolerance=None))
    (zero,) = found.zeros
    assert zero.complete
    assert found.exit_code in exits
    assert found.solves <= MOST_SOLVES
    return zero.best.x


@pytest.mark.parametrize("mu", PUBLISHED)
def test_least_thickness(mu: float) -> None:
    found = least_thickness(VOUSSOIRS[mu], mu)
    assert found == pytest.approx(PUBLISHED[mu], abs=1e-5)
    assert margin(found - NEAR, VOUSSOIRS[mu], mu) == FALLS
    assert margin(found + NEAR, VOUSSOIRS[mu], mu) > 0.0


@pytest.mark.parametrize("mu", [0.7, 0.35])
def test_the_planar_linear_program_has_the_same_limit(mu: float) -> None:
    found = least_thickness(VOUSSOIRS[mu], mu)
    assert arch_load_factor(centre_line_arch(found + 2e-6, VOUSSOIRS[mu]), mu) is not None
    assert arch_load_factor(centre_line_arch(found - 4e-6, VOUSSOIRS[mu]), mu) is None


@pytest.mark.parametrize("thickness", [0.15, 0.3, 0.6])
def test_below_the_least_friction_no_thickness_stands(thickness: float) -> None:
    assert margin(thickness, 60, 0.308) == FALLS


@pytest.mark.parametrize("mu", [0.7, 0.38, 0.35, 0.31])
def test_least_thickness_with_720_voussoirs(mu: float) -> None:
    found = least_thickness(LONG, mu, exits=(0, 4))
    assert found == pytest.approx(PUBLISHED[mu], abs=1e-6)
