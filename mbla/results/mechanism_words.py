"""Mechanisms in words: hinges and where they are, sliding and where to, what opens, which blocks move."""

from __future__ import annotations

from collections import Counter

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.results.mechanics import (
    InterfaceMode,
    curvature_sides,
    global_forces,
    hinge_positions,
    interface_modes,
    moving_blocks,
    sum_by_interface,
)
from mbla.results.text import counted, sentence, table, vector
from mbla.solution.solution import ContactMode, Mechanics

MOST_ROWS = 20
"""rows of a table in the listing; the result files hold all of them"""
MOST_NAMED = 3
"""blocks named in a summary"""


def mechanism_summary(model: Model, contacts: Contacts, mechanics: Mechanics) -> str:
    """``4 hinges, sliding at 2 interfaces; 23 of 27 free blocks move``."""
    modes = interface_modes(contacts, mechanics)
    count = Counter(modes.tolist())
    moving = moving_blocks(mechanics.mechanism, model.blocks.sizes)
    words = [
        counted(count[InterfaceMode.HINGE], "hinge") if count[InterfaceMode.HINGE] else "",
        f"sliding at {counted(count[InterfaceMode.SLIDE], 'interface')}" if count[InterfaceMode.SLIDE] else "",
        f"twisting at {counted(count[InterfaceMode.TWIST], 'interface')}" if count[InterfaceMode.TWIST] else "",
        f"{counted(count[InterfaceMode.OPEN], 'interface')} open" if count[InterfaceMode.OPEN] else "",
    ]
    found = ", ".join(word for word in words if word) or "no interface opens or slides"
    verb = "moves" if moving.sum() == 1 else "move"
    return f"{found}; {int(moving.sum())} of {counted(len(model.free), 'free block')} {verb}"


def mechanism_lines(model: Model, contacts: Contacts, mechanics: Mechanics) -> list[str]:
    """Moving blocks by group, then a table for each mode."""
    modes = interface_modes(contacts, mechanics)
    lines = _moving_lines(model, mechanics)
    lines += _hinge_lines(model, contacts, mechanics, np.flatnonzero(modes == InterfaceMode.HINGE))
    lines += _sliding_lines(model, contacts, mechanics, np.flatnonzero(modes == InterfaceMode.SLIDE))
    for mode, title in ((InterfaceMode.TWIST, "Twisting about their normal"), (InterfaceMode.OPEN, "Open")):
        rows = np.flatnonzero(modes == mode)
        named = [[_pair(model, contacts, i), _position(contacts.centroids[i], model)] for i in rows[:MOST_ROWS]]
        lines += _titled(f"{title}:", ["interface", f"at [{model.units.length}]"], named, len(rows))
    return lines


def _moving_lines(model: Model, mechanics: Mechanics) -> list[str]:
    moving = moving_blocks(mechanics.mechanism, model.blocks.sizes)
    total, moved = Counter(model.blocks.groups), Counter(np.array(model.blocks.groups)[moving].tolist())
    words = ", ".join(f"{moved[group]} of {total[group]} in {group}" for group in total if moved[group])
    return sentence(f"Blocks that move: {words or 'none'}.")


def _hinge_lines(model: Model, contacts: Contacts, mechanics: Mechanics, rows: IntArray) -> list[str]:
    positions = hinge_positions(contacts, mechanics)
    outward = curvature_sides(model, contacts)
    slides = sum_by_interface(contacts, (mechanics.modes == ContactMode.SLIDE).astype(float)) > 0
    named = [
        [
            _pair(model, contacts, i),
            _position(positions[i], model),
            _side(positions[i] - contacts.centroids[i], outward[i]) + (", slides" if slides[i] else ""),
        ]
        for i in rows[:MOST_ROWS]
    ]
    return _titled("Hinges:", ["interface", f"at [{model.units.length}]", "side"], named, len(rows))


def _side(offset: FloatArray, outward: FloatArray) -> str:
    """Where a hinge lies on its interface: intrados or extrados in an arch, else the axis that it is off to."""
    along = float(offset @ outward)
    if abs(along) > 0.5 * np.linalg.norm(offset) * np.linalg.norm(outward):
        return "extrados" if along > 0 else "intrados"
    return f"{_axis(offset)} side"


def _axis(direction: FloatArray) -> str:
    axis = int(np.argmax(np.abs(direction)))
    return ("+" if direction[axis] > 0 else "-") + "xyz"[axis]


def _sliding_lines(model: Model, contacts: Contacts, mechanics: Mechanics, rows: IntArray) -> list[str]:
    velocities = mechanics.contact_velocities * [0.0, 1.0, 1.0]
    total = sum_by_interface(contacts, global_forces(contacts, velocities))
    sizes = np.linalg.norm(total, axis=1)
    named = [
        [
            f"{model.body_name(int(contacts.bodies[i, 1]))} over {model.body_name(int(contacts.bodies[i, 0]))}",
            _position(contacts.centroids[i], model),
            vector(np.round(total[i] / (sizes[i] or 1.0), 3)),
        ]
        for i in rows[:MOST_ROWS]
    ]
    return _titled("Sliding:", ["interface", f"at [{model.units.length}]", "along"], named, len(rows))


def _titled(title: str, head: list[str], rows: list[list[str]], total: int) -> list[str]:
    if not rows:
        return []
    lines = [*sentence(title), *table(head, rows, left=len(head))]
    return lines + (
        sentence(f"and {total - len(rows)} more; the result files hold them all") if total > len(rows) else []
    )


def _pair(model: Model, contacts: Contacts, interface: int) -> str:
    a, b = contacts.bodies[interface].tolist()
    return f"{model.body_name(a)}/{model.body_name(b)}"


def _position(point: FloatArray, model: Model) -> str:
    return vector(point, float(np.abs(model.blocks.vertices).max(initial=0.0)))


def certificate_lines(model: Model, certificate: FloatArray) -> list[str]:
    """Which blocks cannot be held, and what they do, the fastest first."""
    order = _not_held(model, certificate)
    named = [[model.blocks.name(b), _motion_words(certificate[b], model.blocks.sizes[b])] for b in order[:MOST_ROWS]]
    return _titled(f"Not held ({counted(len(order), 'block')}):", ["block", "motion"], named, len(order))


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
    moving = moving_blocks(certificate, model.blocks.sizes)
    speeds = (
        np.linalg.norm(certificate[:, :3], axis=1) + np.linalg.norm(certificate[:, 3:], axis=1) * model.blocks.sizes / 2
    )
    return [int(b) for b in np.argsort(-speeds, kind="stable") if moving[b]]


def _motion_words(motion: FloatArray, size: float) -> str:
    """``moves down`` or ``moves towards +x and turns about +y``, by what dominates."""
    travel, turning = np.linalg.norm(motion[:3]), np.linalg.norm(motion[3:]) * size / 2
    words = []
    if travel > 0.1 * (travel + turning):
        words.append(
            {"-z": "moves down", "+z": "moves up"}.get(_axis(motion[:3]), f"moves towards {_axis(motion[:3])}")
        )
    if turning > 0.1 * (travel + turning):
        words.append(f"turns about {_axis(motion[3:])}")
    return " and ".join(words)
