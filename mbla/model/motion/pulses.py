"""Pulses of base acceleration.

With the duration t_p, each of amplitude 1: rectangle 1; half_sine sin(π t/t_p); sine sin(2π t/t_p), one full wave; and
dejong, 1 for t_p, then −1/2 for 2 t_p, after which the base is at rest: the impulse under which masonry arches and
columns are tried (Oppenheim 1992, Earthquake Engineering and Structural Dynamics 21, 1005-1017; De Lorenzis, DeJong and
Ochsendorf 2007, there 36, 2119-2136).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from mbla.model.motion.signal import Signal

SAMPLES = 2000
"""parts of a half wave, straight lines of which lack 2e-7 of its impulse"""


def pulse_of(form: str, duration: float) -> Signal:
    """The pulse of amplitude 1."""
    return PULSES[form](duration)


def _rectangle(duration: float) -> Signal:
    return Signal(np.array([0.0, duration]), np.ones(2))


def _half_sine(duration: float) -> Signal:
    phases = np.linspace(0.0, 1.0, SAMPLES + 1)
    return Signal(duration * phases, np.sin(np.pi * phases))


def _sine(duration: float) -> Signal:
    phases = np.linspace(0.0, 1.0, 2 * SAMPLES + 1)
    return Signal(duration * phases, np.sin(2.0 * np.pi * phases))


def _dejong(duration: float) -> Signal:
    return Signal(duration * np.array([0.0, 1.0, 1.0, 3.0]), np.array([1.0, 1.0, -0.5, -0.5]))


PULSES: dict[str, Callable[[float], Signal]] = {
    "half_sine": _half_sine,
    "rectangle": _rectangle,
    "sine": _sine,
    "dejong": _dejong,
}
