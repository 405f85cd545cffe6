"""Modes of vibration in words and as a table, and those after a time history beside those before it."""

from __future__ import annotations

import numpy as np

from mbla.assembly.assembly import Assembly
from mbla.results.listing.blocks import GAP, MOST_ROWS, Block, Paragraph, apart, table_of
from mbla.results.listing.text import counted, number
from mbla.results.results import CaseResult
from mbla.solution.modes.modes import Modes

AT_POINTS = (
    "Their joints bend by their whole surface, or by the part that presses. In the time history joints are springs at "
    "contact points: its own first period is another one."
)
"""of modes beside a time history"""

NOT_TOGETHER = (
    "Blocks that `rigid` lets move as one in the time history are blocks by themselves here: modes have the joints "
    "between them as well, and longer periods."
)
"""of modes beside a time history in which some blocks move as one"""

HOW_COMPARED = (
    "Blocks are where it left them. A longer period says that joints have opened or stones have slid. Modes are "
    "compared by their numbers: look at the masses, too."
)
AFTER_HEAD = ["mode", "before [s]", "after [s]", "change [%]", "mass x", "mass y", "mass z", "sum x", "sum y", "sum z"]
"""of modes after a time history"""

SMALL = 5e-5
"""share of mass that is nothing as it is written"""


def modes_words(case: CaseResult) -> str:
    """The first period, in a sentence; why there is none where modes are asked for, else nothing."""
    modes = case.solution.further.modes
    if not len(modes):
        return next((str(each) for each in case.solution.remarks if each.identifier == "no-modes"), "")
    along = int(modes.masses[0].argmax())
    share = f"{100.0 * modes.masses[0, along]:.3g} % of the mass takes part along {'xyz'[along]}"
    said = "" if modes.verified else "modes are NOT verified: "
    said += f"vibrates with a first period of {number(modes.period)} s, {number(float(modes.frequencies[0]))} Hz"
    said = f"{said}, in which {share if modes.masses[0, along] > SMALL else 'no mass takes part on the whole'}"
    after = case.solution.further.modes_after
    if not len(after):
        return said
    known = "" if after.verified else "modes after it are NOT verified: "
    words = f"the first period is {number(after.period)} s, {_change(modes.period, after.period)}"
    return f"{said}; after the time history {known}{words}"


def modes_blocks(assembly: Assembly, case: CaseResult) -> list[Block]:
    """How stiff joints are, and a row for each mode; nothing without any."""
    modes = case.solution.further.modes
    if not len(modes):
        return []
    known = "verified" if modes.verified else "NOT verified"
    together = ", ".join(
        f"{100.0 * share:.3g} % along {axis}" for axis, share in zip("xyz", modes.masses.sum(0), strict=True)
    )
    says = f"{counted(len(modes), 'mode')} of vibration about the state at rest under the dead load, {known}. "
    says += f"Of the mass that moves they have {together}. {_stiffness(assembly, modes)}"
    shown = modes.masses[:MOST_ROWS]
    rows = [
        [str(row + 1), number(float(period)), number(float(1.0 / period)), *map(_share, shares), *map(_share, so_far)]
        for row, (period, shares, so_far) in enumerate(
            zip(modes.periods[:MOST_ROWS], shown, modes.masses.cumsum(axis=0)[:MOST_ROWS], strict=True)
        )
    ]
    head = ["mode", "period [s]", "frequency [Hz]", "mass x", "mass y", "mass z", "sum x", "sum y", "sum z"]
    beside = _beside(case)
    found = [Paragraph(says), *beside, *apart(table_of(head, rows, left=0, total=len(modes)))]
    return [*found, *_after_blocks(case)]


def _beside(case: CaseResult) -> list[Block]:
    """How modes differ from the time history that they are beside, where there is one."""
    history = case.load_case.time_history
    if history is None or case.solution.further.time_history.rows is None:
        return []
    return [Paragraph(AT_POINTS), *([Paragraph(NOT_TOGETHER)] if history.rigid else [])]


def _after_blocks(case: CaseResult) -> list[Block]:
    """A row for each mode after the time history, beside the one of the same number before it; nothing without any."""
    before, after = case.solution.further.modes, case.solution.further.modes_after
    if not len(after):
        return []
    known = "verified" if after.verified else "NOT verified"
    says = f"After the time history: {counted(len(after), 'mode')} about the state it leaves, {known}. {HOW_COMPARED}"
    rows = [_row(before, after, row) for row in range(min(max(len(before), len(after)), MOST_ROWS))]
    return [GAP, Paragraph(says), *apart(table_of(AFTER_HEAD, rows, left=0))]


def _row(before: Modes, after: Modes, row: int) -> list[str]:
    """Periods of a mode before and after, the change, and masses after; dashes where there is no such mode."""
    old, new = (number(float(each.periods[row])) if row < len(each) else "-" for each in (before, after))
    if row >= len(after):
        return [str(row + 1), old, new, *["-"] * 7]
    change = f"{_per_cent(before.periods[row], after.periods[row]):+.1f}" if row < len(before) else "-"
    so_far = after.masses[: row + 1].sum(axis=0)
    return [str(row + 1), old, new, change, *map(_share, after.masses[row]), *map(_share, so_far)]


def _per_cent(before: float, after: float) -> float:
    """By how much a period is longer, without the sign of what rounds to nothing."""
    change = 100.0 * (after / before - 1.0)
    return change if abs(change) >= 0.05 else 0.0


def _change(before: float, after: float) -> str:
    """The same in words."""
    change = _per_cent(before, after)
    return f"{abs(change):.1f} % {'longer' if change > 0.0 else 'shorter'}" if change else "as before"


def _stiffness(assembly: Assembly, modes: Modes) -> str:
    """How stiff joints are, and by how much they give at rest."""
    units = assembly.model.units
    of_joints = modes.stiffness[assembly.contacts.areas > 0.0][:, 0]
    least, most = float(of_joints.min()), float(of_joints.max())
    stiff = number(least) if np.isclose(least, most, rtol=1e-9) else f"{number(least)} to {number(most)}"
    names = assembly.contacts.joint_names
    given = all(not np.isnan(assembly.model.joints[name].normal_stiffness) for name in names)
    source = "" if given else ", next to rigid where the deck gives none: give theirs for periods as they are"
    pressed = float(modes.pressed @ assembly.contacts.areas / assembly.contacts.areas.sum())
    slack = "" if not modes.slack else f" {_slack_words(modes.slack)}"
    return (
        f"Joints have a stiffness of {stiff} {units.force}/{units.length}3{source}; at rest blocks sag by up to "
        f"{number(modes.sag)} {units.length}, and {100.0 * pressed:.3g} % of the area of joints presses.{slack}"
    )


def _slack_words(slack: int) -> str:
    """Of ties that are left out."""
    if slack == 1:
        return "1 tie carries nothing at rest and is left out; in a time history it holds as soon as it is pulled."
    return (
        f"{slack} ties carry nothing at rest and are left out; in a time history they hold as soon as they are pulled."
    )


def _share(share: float) -> str:
    """A share of mass, four digits behind the point."""
    return f"{share:.4f}" if share > SMALL else "0"
