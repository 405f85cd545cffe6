"""Where the power of a mechanism goes, in words: loads and joints, and laws and groups where there are several."""

from __future__ import annotations

from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.results.collapse.work import Work, dissipated_by_joint, loads_by_group
from mbla.results.listing.text import MOST_ROWS, counted, sentence, table
from mbla.solution.solution import Mechanics


def work_lines(model: Model, contacts: Contacts, load_case: LoadCase, mechanics: Mechanics, work: Work) -> list[str]:
    """Shares of the power that the loads put in; nothing where they put in none."""
    if work.given <= 0:
        return []
    settles = load_case.settlement is not None  # whose dead load holds the reaction at rest
    dead = "the reaction at rest less what the weights give" if settles else "the dead load"
    sinks = (
        (dead, -work.dead, work.dead <= 0),
        ("the live load", -work.live, False),
        ("friction", float(work.friction.sum()), True),
        ("cohesion", float(work.cohesion.sum()), False),
        ("the joints' normal forces", max(float(work.normal.sum()), 0.0), False),
    )
    shares = [
        (name, power_share(power, work), always)
        for name, power, always in sinks
        if not (name in (dead, "the live load") and power < 0)
    ]
    into = ", ".join(f"{share} % into {name}" for name, share, always in shares if always or float(share) != 0.0)
    into = into.replace(" % into", " % goes into", 1)
    back = power_share(-float(work.normal.sum()), work)
    back = f"; joints lift as they slide, and their normal forces give {back} % back" if float(back) > 0 else ""
    lines = sentence(f"{_source(load_case, work)}{into}{back}.")
    groups = [] if settles else _group_table(model, load_case, mechanics, work)
    return lines + _joint_table(contacts, work) + groups


def _source(load_case: LoadCase, work: Work) -> str:
    """Where the power comes from."""
    if load_case.settlement is not None and work.dead <= 0:
        return "Of the power of the reaction that the support loses "
    if work.dead <= 0:
        return "Of the power of the live load "
    if work.live <= 0:
        return "The dead load drives the mechanism. Of its power "
    live, dead = power_share(work.live, work), power_share(work.dead, work)
    return f"The live load gives {live} % of the power, the dead load {dead} %. Of both "


def power_share(power: float, work: Work) -> str:
    """Percentage of the power that is put in, ``-`` where none is."""
    return f"{round(100 * power / work.given, 1) + 0.0:.1f}" if work.given > 0 else "-"


def _joint_table(contacts: Contacts, work: Work) -> list[str]:
    joints = dissipated_by_joint(contacts, work)
    if len(joints) < 2:
        return []
    rows = [[name, *(power_share(power, work) for power in powers)] for name, powers in joints.items()]
    return table(["joint law", "friction [%]", "cohesion [%]", "normal forces [%]"], rows)


def _group_table(model: Model, load_case: LoadCase, mechanics: Mechanics, work: Work) -> list[str]:
    """Groups by the size of what they add, live or dead."""
    groups = loads_by_group(model, load_case, mechanics)
    ordered = sorted(groups.items(), key=lambda item: -max(abs(power) for power in item[1]))
    shares = [[name, power_share(live, work), power_share(-dead, work)] for name, (live, dead) in ordered]
    rows = [row for row in shares if float(row[1]) or float(row[2])]
    if len(rows) < 2:
        return []
    more = sentence(f"and {counted(len(rows) - MOST_ROWS, 'more group')}") if len(rows) > MOST_ROWS else []
    return table(["group", "live load [%]", "into its dead load [%]"], rows[:MOST_ROWS]) + more
