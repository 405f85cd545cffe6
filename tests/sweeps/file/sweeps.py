"""Working sweep files that the tests of the sweep file change one thing in."""

from __future__ import annotations

from pathlib import Path

from mbla.sweeps.base import Base, read_base
from mbla.sweeps.file.read import read_sweep
from tests.deck.decks import write

FOLDER = Path(__file__).parents[2] / "invalid_sweeps"
ARCH = (FOLDER / "deck.yaml").read_text(encoding="utf-8")

GOOD = """mbla_sweep: 1
title: Arch over friction and thickness
deck: deck.yaml
parameters:
  mu: {linear: {from: 0.3, to: 0.7, points: 5}}
  t: {values: [0.1, 0.15, 0.2]}
"""

ALL_WAYS = """mbla_sweep: 1
title: Every key of a sweep file
deck: deck.yaml
cases: [down, push_x]
set: {blocks.0.arch.width: 0.4, "analysis.accuracy": draft}
parameters:
  mu: {linear: {from: 0.7, to: 0.3, points: 3}}
  t: {log: {from: 0.1, to: 0.2, points: 3}, unit: m}
  n: {key: blocks.0.arch.voussoirs, whole: {from: 19, to: 21}}
  joints.dry.cohesion: {normal: {mean: 100, deviation: 20, min: 50, max: 200}}
  tension: {key: joints.dry.tensile_strength, lognormal: {mean: 10, deviation: 2, min: 1, max: 20}}
  density: {key: [materials.stone.density], uniform: {from: 1800, to: 2400}}
  radius: {triangular: {from: 0.9, mode: 1, to: 1.1}}
  d: {key: load_cases.push_x.live.0.acceleration, horizon: {from: 0, to: 90, points: 4, size: 2}}
  g: {key: load_cases.down.live.0.acceleration, sphere: {from: -10, to: 10}}
  law: {key: contacts.joint, values: [dry, glued]}
design:
  - grid: {of: [mu, law]}
  - zip: {of: [t, n]}
  - random: {of: [joints.dry.cohesion], points: 4, seed: 7}
  - latin_hypercube: {of: [tension, g], points: 4}
  - sobol: {of: [density, radius], points: 4}
  - grid: {}
constraints: ["t < 0.2*radius"]
results: [status, load_factor, model.total_weight]
limits: {time: "2 min", memory: 500}
output: {files: failed, parquet: true, hdf5: true}
"""


def base_of(folder: Path, sweep: str = GOOD, deck: str = ARCH, *overrides: str) -> Base:
    """Base of a sweep, both written to a folder."""
    write(folder, deck)
    return read_base(read_sweep(write(folder, sweep, "sweep.yaml"), overrides))
