"""The motion that shows a lack of equilibrium in words: which blocks cannot be held, and what they do."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.model import Model
from mbla.results.collapse.rigid_parts import block_speeds, resting_blocks
from mbla.results.words.text import counted, sentence, table

MOST_ROWS = 20
"""rows of a table in the listing; the result files hold all of them"""
MOST_NAMED = 3
"""blocks named in a summary"""


def certificate_lines(model: Model, certificate: FloatArray) -> list[str]:
    """Which blocks cannot be held, and what they do, the fastest first."""
    order = _not_held(model, certificate)
    rows = [[model.blocks.name(b), _motion_words(certificate[b], model.blocks.sizes[b])] for b in order[:MOST_ROWS]]
    if not rows:
        return []
    more = sentence(f"and {len(order) - len(rows)} more; the result files hold them all")
    lines = [*sentence(f"Not held ({counted(len(order), 'block')}):"), *table(["block", "motion"], rows, left=2)]
    return lines + (more if len(order) > len(rows) else [])


def not_held_summary(model: Model, certificate: FloatArray) -> str:
    """``not held: tower[0] (moves down), tower[1] (moves down) and 3 more``."""
    order = _not_held(model, certificate)
    words = [
        f"{model.blocks.name(b)} ({_motion_words(certificate[b], model.blocks.sizes[b])})" for b in order[:MOST_NAMED]
    ]
    more = f" and {len(order) - MOST_NAMED} more" if len(order) > MOST_NAMED else ""
    return f"not held: {', '.join(words)}{more}" if words else ""


def _not_held(model: Model, certificate: FloatArray) -> list[int]:
    """Moving blocks, the fastest first."""
    rest, speeds = resting_blocks(model, certificate), block_speeds(model, certificate)
    return [int(b) for b in np.argsort(-speeds, kind="stable") if not rest[b]]


def _motion_words(motion: FloatArray, size: float) -> str:
    """``moves down`` or ``moves towards +x and turns about +y``, by what dominates."""
    travel, turning = np.linalg.norm(motion[:3]), np.linalg.norm(motion[3:]) * size / 2
    words = []
    if travel > 0.1 * (travel + turning):
        axis = _axis(motion[:3])
        words.append({"-z": "moves down", "+z": "moves up"}.get(axis, f"moves towards {axis}"))
    if turning > 0.1 * (travel + turning):
        words.append(f"turns about {_axis(motion[3:])}")
    return " and ".join(words)


def _axis(direction: FloatArray) -> str:
    axis = int(np.argmax(np.abs(direction)))
    return ("+" if direction[axis] > 0 else "-") + "xyz"[axis]
