"""The synthetic record of decks/time_histories, made anew: ``python -m tests.decks.synthetic_record --write``.

It is no earthquake. Two components, each a sum of 160 waves of random phase, 0.5 to 20 Hz, whose amplitudes follow the
spectrum of Kanai and Tajimi for firm ground (ω_g = 15.7 rad/s, ζ_g = 0.6), times an envelope that rises to 1 within 0.5
s, stays until 2.5 s and falls to 0 at 4 s; less the cubic that leaves neither velocity nor displacement at the end, nor
acceleration at both ends; scaled to a greatest acceleration of 0.3 g and 0.25 g.
"""

from __future__ import annotations

import sys

import numpy as np

from mbla.arrays import FloatArray
from tests.decks.folder import DECKS

PATH = DECKS / "time_histories" / "synthetic.csv"
STEP, LENGTH = 0.01, 4.0
"""s"""
PEAKS, SEED = (0.3, 0.25), 54
"""g"""


def components() -> tuple[FloatArray, FloatArray]:
    """Times, (n,) s, and accelerations, (n, 2) g."""
    random = np.random.default_rng(SEED)
    times: FloatArray = np.arange(round(LENGTH / STEP) + 1, dtype=np.float64) * STEP
    frequencies = np.linspace(0.5, 20.0, 160)
    ratio = 2.0 * np.pi * frequencies / 15.7
    power = (1.0 + (1.2 * ratio) ** 2) / ((1.0 - ratio**2) ** 2 + (1.2 * ratio) ** 2)
    envelope = np.interp(times, [0.0, 0.5, 2.5, LENGTH], [0.0, 1.0, 1.0, 0.0])
    found = []
    for peak in PEAKS:
        phases = random.uniform(0.0, 2.0 * np.pi, len(frequencies))
        waves = np.sqrt(power) * np.cos(2.0 * np.pi * np.outer(times, frequencies) + phases)
        acceleration = _at_rest_after(times, envelope * waves.sum(axis=1))
        found.append(peak / np.abs(acceleration).max() * acceleration)
    return times, np.stack(found, axis=1)


def _at_rest_after(times: FloatArray, acceleration: FloatArray) -> FloatArray:
    """Less the two shapes that vanish at both ends with which velocity and displacement at the end are zero."""
    tau = times / times[-1]
    shapes = np.stack([tau * (1.0 - tau), tau * (1.0 - tau) * (1.0 - 2.0 * tau)], axis=1)
    ends = np.stack([_ends(times, shape) for shape in shapes.T], axis=1)
    return np.asarray(acceleration - shapes @ np.linalg.solve(ends, _ends(times, acceleration)))


def _ends(times: FloatArray, acceleration: FloatArray) -> FloatArray:
    """Velocity and displacement at the end, of straight lines between the values."""
    step = times[1] - times[0]
    velocity = np.concatenate([[0.0], np.cumsum(0.5 * step * (acceleration[1:] + acceleration[:-1]))])
    parts = step * velocity[:-1] + step**2 * (acceleration[:-1] / 3.0 + acceleration[1:] / 6.0)
    return np.array([velocity[-1], parts.sum()])


def text() -> str:
    """Of the file."""
    lines = ["synthetic record, no earthquake: tests/decks/synthetic_record.py; accelerations in g", "t,along,across"]
    times, values = components()
    lines += [f"{t:.2f},{x:.7f},{y:.7f}" for t, (x, y) in zip(times, values, strict=True)]
    return "\n".join(lines) + "\n"


if __name__ == "__main__" and "--write" in sys.argv:
    PATH.write_text(text(), encoding="utf-8")
