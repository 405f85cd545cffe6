"""The decks of Cocchetti and Rizzi's arch, which have a line for the load on every voussoir.

``python -m tests.decks.centre_line_arches`` writes them again; a test holds them equal to what this gives.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from tests.analytic.planar import arch_load_factor, centre_line_arch

FOLDER = Path(__file__).parents[2] / "decks" / "benchmarks"
VOUSSOIRS = 86
"""Joints every 2.093 degrees: one lies within 0.07 degrees of the hinges of the frictional limit, 54.48 degrees."""


@dataclass(frozen=True)
class Case:
    """A deck: friction mu, thickness over mean radius, the published least thickness (None: there is none)."""

    name: str
    mu: float
    thickness: float
    least: float | None


CASES = (
    Case("cocchetti_rizzi_mu_700_stands", 0.7, 0.1095, 0.107426),
    Case("cocchetti_rizzi_mu_700_falls", 0.7, 0.1073, 0.107426),
    Case("cocchetti_rizzi_mu_380_stands", 0.38, 0.126, 0.122192),
    Case("cocchetti_rizzi_mu_380_falls", 0.38, 0.1220, 0.122192),
    Case("cocchetti_rizzi_mu_350_stands", 0.35, 0.16, 0.152920),
    Case("cocchetti_rizzi_mu_350_falls", 0.35, 0.1527, 0.152920),
    Case("cocchetti_rizzi_mu_310_stands", 0.31, 0.203, 0.199653),
    Case("cocchetti_rizzi_mu_310_falls", 0.31, 0.1994, 0.199653),
    Case("cocchetti_rizzi_mu_305_falls", 0.305, 0.35, None),
)


def deck_text(case: Case) -> str:
    """The whole deck."""
    return "\n".join([*_head(case), *_structure(), *_loads(), *_expected(case), ""])


def _head(case: Case) -> Iterator[str]:
    limit = "no thickness stands" if case.least is None else f"least t/r = {case.least:g}"
    verb = "stands" if case.name.endswith("stands") else "falls"
    title = f"Semicircular arch with its weight on the centre line, friction {case.mu:g}, t/r {case.thickness:g}"
    numbers = f"mu: {case.mu:g}, t: {case.thickness:g}, w: 0.5"
    yield "# yaml-language-server: $schema=../../schemas/deck.schema.json"
    yield "# Semicircular arch of Cocchetti and Rizzi (Frattura ed Integrita Strutturale 51, 2020, 356-375, Tables"
    yield "# 1 and 3): radial joints, mean radius 1, weight along the centre line. It is applied as a force on each"
    yield "# voussoir, at the centroid of its arc, so that every joint has the resultant of the continuous arch; the"
    yield "# blocks' own weight is not used."
    yield f"# Friction {case.mu:g}: {limit}. Here t/r = {case.thickness:g}: the arch {verb}."
    if case.least is not None:
        yield "# (--set parameters.t=... tries another thickness. With joints at a finite number of places the arch"
        yield "# stands down to a thickness that is smaller by up to 6e-5.)"
    else:
        yield "# Below mu = 0.309215 the arch slides at its springings whatever its thickness."
    yield "# Generated: tests/decks/centre_line_arches.py."
    yield "mbla: 1"
    yield f"title: {title}"
    yield f'parameters: {{{numbers}, d: "=180/{VOUSSOIRS}", r: "=sin(d/2)/(d*pi/360)", xc: "=1-t/2"}}'


def _structure() -> Iterator[str]:
    yield ""
    yield "materials:"
    yield "  stone: {density: 1}"
    yield "joints:"
    yield '  dry: {friction: "=mu"}'
    yield ""
    yield "blocks:"
    yield "  - arch:"
    yield "      group: arch"
    yield "      material: stone"
    yield "      shape: semicircular"
    yield '      span: "=2*xc"'
    yield '      thickness: "=t"'
    yield '      width: "=w"'
    yield f"      voussoirs: {VOUSSOIRS}"
    yield "      springers: ground"
    yield ""
    yield "contacts: {joint: dry}"
    yield ""


def _loads() -> Iterator[str]:
    yield "load_cases:"
    yield "  push_x:"
    for kind, force in (("dead", "[0, 0, -1]"), ("live", "[1, 0, 0]")):
        yield f"    {kind}:"
        if kind == "dead":
            yield "      - {gravity: none}"
        for i in range(VOUSSOIRS):
            angle = f"{i + 0.5:g}*d"
            point = f'["=xc-r*cos({angle})", "=w/2", "=r*sin({angle})"]'
            yield f"      - {{force: {force}, on: {{group: arch, index: {i}}}, at: {point}}}"
    yield ""
    yield "analysis: {flow_rule: associative, accuracy: reference}"
    yield "output: {vtu: false}"
    yield ""


def _expected(case: Case) -> Iterator[str]:
    published = "Cocchetti and Rizzi 2020"
    factor = arch_load_factor(centre_line_arch(case.thickness, VOUSSOIRS), case.mu)
    yield "expected:"
    yield "  push_x:"
    if factor is not None:
        yield f"    load_factor: {factor:.7e}"
        yield "    tolerance: 1.e-5"
    yield f"    status: {'no_equilibrium' if factor is None else 'solved'}"
    yield f'    source: "planar linear program; that it {"falls" if factor is None else "stands"}: {published}"'


def main() -> None:
    """Write all decks."""
    for case in CASES:
        (FOLDER / f"{case.name}.yaml").write_text(deck_text(case), encoding="utf-8")


if __name__ == "__main__":
    main()
