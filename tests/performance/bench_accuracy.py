"""What each knob of speed against accuracy costs and brings; appends to results/accuracy.csv.

::

    python -m tests.performance.bench_accuracy [NAME ...]

Structures of the standard set, the smaller ones unless others are named. Each preset as it is, then one knob at a time
turned away from ``accuracy: standard``. Distances are from ``accuracy: reference``; the static form, friction polyhedra
and interface resultants are in the list to show what presets leave alone.
"""

from __future__ import annotations

import io
import sys
import time

from mbla.contacts.findings import contacts_of
from mbla.contacts.glue import held_model
from mbla.deck import read_deck
from mbla.model import build_model
from mbla.model.model import select_cases
from mbla.results.results import CaseResult
from mbla.results.sta import StatusFile
from mbla.run import solve_case
from mbla.solution.settings import solver_settings
from tests.performance.recording import record
from tests.performance.standard_set import FLOW_RULES, STANDARD_SET, Structure

SMALL = (
    *(f"wall, {kind}, {n} x {n}" for kind in ("planar", "spatial") for n in (5, 10, 20)),
    *(f"arch, {n} voussoirs" for n in (20, 50, 100)),
    "dome",
    "cross vault",
)
SLOW = ("cross vault",)
"""Not solved without dilatancy unless named: a minute a run."""

PRESETS = ("reference", "standard", "draft")
ASSOCIATIVE = (
    "tolerance=1e-4",
    "tolerance=1e-6",
    "tolerance=1e-8",
    "gap=1e-3",
    "forces=solver",
    "standing=false",
    "friction_cone=polyhedral",
    "contact_model=convex",
)
WITHOUT_NORMALITY = (
    "tolerance=1e-6",
    "residual=5e-3",
    "residual=1e-4",
    "range=false",
    "peak=false",
    "standing=false",
)


def solved(structure: Structure, flow_rule: str, *knobs: str) -> tuple[CaseResult, float]:
    """The load case with its verification, and the seconds of the processor from its program on."""
    given = (f"analysis.flow_rule={flow_rule}", *(f"analysis.{knob}" for knob in knobs))
    deck = read_deck(structure.deck, [*structure.overrides, *given])
    model = build_model(deck)
    contacts = contacts_of(deck, model)
    model = held_model(model, contacts)
    (load_case,) = select_cases(model, (structure.load_case,))
    settings, status_file = solver_settings(deck.analysis), StatusFile(io.StringIO(), "benchmark")
    started = time.process_time()
    case = solve_case(deck, model, contacts, load_case, settings, status_file, None)
    return case, time.process_time() - started


def ladder(structure: Structure, flow_rule: str) -> None:
    """All presets and knobs on one structure, a row each."""
    knobs = ASSOCIATIVE if flow_rule == "associative" else WITHOUT_NORMALITY
    reference, standard = float("nan"), float("nan")
    for setting in (*(f"accuracy={name}" for name in PRESETS), *knobs):
        case, seconds = solved(structure, flow_rule, setting)
        checks, mechanics = case.checks, case.solution.mechanics
        factor = float("nan") if mechanics is None else mechanics.load_factor
        reference = factor if setting == "accuracy=reference" else reference
        standard = seconds if setting == "accuracy=standard" else standard
        figures = (
            checks.equilibrium_residual,
            checks.yield_violation,
            checks.penetration,
            checks.complementarity_residual,
            checks.power_balance,
        )
        row = {
            "structure": structure.name,
            "flow_rule": flow_rule,
            "setting": setting,
            "status": str(case.status),
            "processor_seconds": seconds,
            "of_standard": seconds / standard,
            "load_factor": f"{factor:.9g}",
            "from_reference": factor / reference - 1.0,
            "static_bound": f"{checks.static_bound:.9g}",
            "kinematic_bound": f"{checks.kinematic_bound:.9g}",
            "gap": checks.gap,
            "residual": max(figures),
        }
        record("accuracy", row)


def main() -> None:
    """The structures that are named, or the smaller ones."""
    named = sys.argv[1:]
    for structure in STANDARD_SET:
        for flow_rule in FLOW_RULES:
            slow = structure.name in SLOW and flow_rule != "associative"
            if structure.name in named or (not named and structure.name in SMALL and not slow):
                ladder(structure, flow_rule)


if __name__ == "__main__":
    main()
