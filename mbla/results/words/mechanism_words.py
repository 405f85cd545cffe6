"""Mechanisms in words: which parts move and how, hinges and their axes, sliding and where to, what opens and twists."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.results.collapse.collapse import Collapse
from mbla.results.collapse.interface_modes import InterfaceMode
from mbla.results.collapse.mechanics import curvature_sides
from mbla.results.words.part_words import direction_words, part_lines
from mbla.results.words.text import counted, sentence, table, vector
from mbla.results.words.work_words import power_share

MOST_ROWS = 20
"""rows of a table in the listing; the result files hold all of them"""


def mechanism_summary(model: Model, collapse: Collapse) -> str:
    """``4 hinges, sliding at 2 interfaces; 23 of 27 free blocks move in 3 parts``."""
    count = collapse.interfaces.count
    moving = int(np.sum(~model.fixed & (collapse.parts > 0)))
    words = [
        (count(InterfaceMode.HINGE), "{}", "hinge"),
        (count(InterfaceMode.SLIDE), "sliding at {}", "interface"),
        (count(InterfaceMode.TWIST), "twisting at {}", "interface"),
        (count(InterfaceMode.OPEN), "{} open", "interface"),
    ]
    found = ", ".join(text.format(counted(n, word)) for n, text, word in words if n) or "no interface opens or slides"
    verb = "moves" if moving == 1 else "move"
    parts = f" in {len(collapse.motions)} parts" if len(collapse.motions) > 1 else ""
    return f"{found}; {moving} of {counted(len(model.free), 'free block')} {verb}{parts}"


def mechanism_lines(model: Model, contacts: Contacts, collapse: Collapse) -> list[str]:
    """Parts, then a table for each mode of interfaces."""
    lines = part_lines(model, collapse.parts, collapse.motions)
    lines += _hinge_lines(model, contacts, collapse)
    lines += _sliding_lines(model, contacts, collapse)
    for mode, title in ((InterfaceMode.TWIST, "Twisting about their normal"), (InterfaceMode.OPEN, "Open")):
        rows, total = _chosen(contacts, collapse, mode)
        named = [[*_pair(model, contacts, collapse, i), _position(contacts.centroids[i], model)] for i in rows]
        lines += _titled(title, ["interface", "parts", f"at [{model.units.length}]"], named, total, 3)
    return lines


def _chosen(contacts: Contacts, collapse: Collapse, mode: InterfaceMode) -> tuple[IntArray, int]:
    """Interfaces of a mode in their order, and how many there are; of too many those that move most, these first."""
    motion = collapse.interfaces
    rows = np.flatnonzero(motion.modes == mode)
    if len(rows) <= MOST_ROWS:
        return rows, len(rows)
    arms = np.zeros(len(contacts))
    np.maximum.at(
        arms,
        contacts.interface_of_point,
        np.linalg.norm(contacts.points - contacts.centroids[contacts.interface_of_point], axis=1),
    )
    speeds = np.linalg.norm(motion.translation, axis=1) + arms * np.linalg.norm(motion.rotation, axis=1)
    relative = np.round(speeds[rows] / (speeds.max(initial=0.0) or 1.0), 6)  # equal ones differ by rounding
    return rows[np.argsort(-relative, kind="stable")[:MOST_ROWS]], len(rows)


def _hinge_lines(model: Model, contacts: Contacts, collapse: Collapse) -> list[str]:
    motion = collapse.interfaces
    outward = curvature_sides(model, contacts)
    rows, total = _chosen(contacts, collapse, InterfaceMode.HINGE)
    named = [
        [
            *_pair(model, contacts, collapse, i),
            _position(motion.hinge_points[i], model),
            direction_words(motion.hinge_directions[i]),
            _side(motion.hinge_points[i] - contacts.centroids[i], outward[i])
            + (", slides" if motion.slides[i] else ""),
        ]
        for i in rows
    ]
    head = ["interface", "parts", f"axis at [{model.units.length}]", "about", "side"]
    return _titled("Hinges", head, named, total, len(head))


def _side(offset: FloatArray, outward: FloatArray) -> str:
    """Where a hinge lies on its interface: intrados or extrados in an arch, else the axis that it is off to."""
    along = float(offset @ outward)
    if abs(along) > 0.5 * np.linalg.norm(offset) * np.linalg.norm(outward):
        return "extrados" if along > 0 else "intrados"
    axis = int(np.argmax(np.abs(offset)))
    return f"{'+' if offset[axis] > 0 else '-'}{'xyz'[axis]} side"


def _sliding_lines(model: Model, contacts: Contacts, collapse: Collapse) -> list[str]:
    """What slides over what, the direction in the plane of the interface, the share of the power."""
    motion = collapse.interfaces
    normal = np.einsum("ij,ij->i", motion.translation, contacts.normals)
    along = motion.translation - normal[:, None] * contacts.normals
    rows, total = _chosen(contacts, collapse, InterfaceMode.SLIDE)
    named = [
        [
            *_slide(model, contacts, collapse, i, along[i]),
            power_share(float(collapse.work.dissipated[i]), collapse.work),
        ]
        for i in rows
    ]
    head = ["interface", "parts", f"at [{model.units.length}]", "along", "power [%]"]
    return _titled("Sliding", head, named, total, 4)


def _slide(model: Model, contacts: Contacts, collapse: Collapse, interface: int, along: FloatArray) -> list[str]:
    """Body b over body a; where b is at rest and a moves, the other way round."""
    a, b = contacts.bodies[interface].tolist()
    parts = [_part(model, collapse, a), _part(model, collapse, b)]
    if parts[1] == 0 < parts[0]:
        a, b, parts, along = b, a, parts[::-1], -along
    direction = vector(np.round(along / (float(np.linalg.norm(along)) or 1.0), 3))
    names = f"{model.body_name(b)} over {model.body_name(a)}"
    return [names, f"{parts[0]}/{parts[1]}", _position(contacts.centroids[interface], model), direction]


def _titled(title: str, head: list[str], rows: list[list[str]], total: int, left: int) -> list[str]:
    if not rows:
        return []
    fastest = f" ({total}; those that move most)" if total > len(rows) else ""
    lines = [*sentence(f"{title}{fastest}:"), *table(head, rows, left=left)]
    more = sentence(f"and {total - len(rows)} more; the result files hold them all")
    return lines + (more if total > len(rows) else [])


def _pair(model: Model, contacts: Contacts, collapse: Collapse, interface: int) -> list[str]:
    """Both bodies and their parts: ``arch[2]/arch[3]``, ``0/2``."""
    a, b = contacts.bodies[interface].tolist()
    parts = f"{_part(model, collapse, a)}/{_part(model, collapse, b)}"
    return [f"{model.body_name(a)}/{model.body_name(b)}", parts]


def _part(model: Model, collapse: Collapse, body: int) -> int:
    """Part of a body; grounds are at rest."""
    return int(collapse.parts[body]) if body < len(model.blocks) else 0


def _position(point: FloatArray, model: Model) -> str:
    return vector(point, float(np.abs(model.blocks.vertices).max(initial=0.0)))
