"""What slides in time does not lift, whatever the flow rule by which load factors of the deck are found."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.assembly import build_assembly
from mbla.deck import read_deck_text
from mbla.model import build_model
from mbla.solution.settings import settings_for, solver_settings
from mbla.solution.time_history.follow import follow

SLIDES = """\
mbla: 1
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.3, stiffness: {normal: 10 GPa/m}}}
blocks: [{box: {group: b, material: stone, min: [0, 0, 0], max: [1, 1, 0.2]}}]
contacts: {joint: dry}
supports: [{ground: {z: 0}}]
load_cases:
  slide:
    time_history:
      motion: {pulse: rectangle, amplitude: 0.5 g, duration: 0.2, direction: x}
      duration: 0.5
      step: 0.005
analysis: {flow_rule: FLOW}
"""


@pytest.mark.parametrize("flow_rule", ["associative", "non_associative", "dilatancy"])
def test_a_sliding_block_stays_on_the_ground(flow_rule: str) -> None:
    """Newmark: V = (a − μ g) t, then μ g slows it down: .0654 m in all; it rises by what the joint gave."""
    deck = read_deck_text(SLIDES.replace("FLOW", flow_rule), Path("deck.yaml"))
    assembly = build_assembly(deck, build_model(deck))
    case = assembly.model.load_cases[0]
    found, _ = follow(assembly, deck.contacts, case, settings_for(case, solver_settings(deck.analysis)))
    assert found.peaks is not None
    assert found.frames is not None
    assert found.peaks.peak == pytest.approx(0.0654, rel=0.01)
    assert np.abs(found.frames.shifts[:, 0, 2]).max() < 1e-6
