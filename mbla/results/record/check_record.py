"""What ``mbla check --json`` tells: the record of a run without results, and what reaches the solver."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from mbla.program.reductions import ReductionStep
from mbla.results.provenance import CaseNeeds
from mbla.results.record.case_parts import REDUCTION
from mbla.results.record.json_record import results_json
from mbla.results.record.objects import Object
from mbla.results.results import Results


@dataclass(frozen=True)
class JointUse:
    """Interfaces of a joint law, and their area."""

    interfaces: int
    area: float


MODEL, JOINT, NEEDS = Object[Results](), Object[JointUse](), Object[CaseNeeds]()


@MODEL.key("a load case")
def load_cases(results: Results) -> list[str]:
    """`mbla check`: names of the load cases."""
    return [case.name for case in results.model.load_cases]


@MODEL.key("a joint law", inside=JOINT)
def joints(results: Results) -> dict[str, JointUse]:
    """`mbla check`: joint laws in use."""
    return {name: JointUse(*use) for name, use in results.contacts.by_joint.items()}


@JOINT.key()
def interfaces(use: JointUse) -> int:
    """Its interfaces."""
    return use.interfaces


@JOINT.key(unit="area")
def area(use: JointUse) -> float:
    """Their area."""
    return use.area


@MODEL.key()
def slivers(results: Results) -> int:
    """`mbla check`: common surfaces dropped as thinner than the tolerance."""
    return len(results.contacts.report.slivers)


@MODEL.key()
def near_misses(results: Results) -> int:
    """`mbla check`: near misses: pairs of bodies that nearly touch."""
    return len(results.contacts.report.near_misses)


@MODEL.key()
def overlaps(results: Results) -> int:
    """`mbla check`: pairs of blocks that overlap."""
    return len(results.contacts.report.overlaps)


@MODEL.key("a block")
def isolated_blocks(results: Results) -> list[str]:
    """`mbla check`: blocks without contact."""
    return [results.model.blocks.name(int(block)) for block in results.contacts.report.isolated]


@MODEL.key()
def unsupported_parts(results: Results) -> int:
    """`mbla check`: parts that reach no support."""
    return len(results.contacts.report.unsupported)


@NEEDS.key("a reduction", inside=REDUCTION)
def reductions(needs: CaseNeeds) -> list[ReductionStep]:
    """What each reduction left out, in the order in which they are applied."""
    return list(needs.reductions)


NOT_OF_CHECKS = ("cases", "series", "objectives", "files", "complete", "not_done")
"""keys of a run that a check has not"""


def check_json(results: Results, needs: Mapping[str, CaseNeeds]) -> dict[str, Any]:
    """The record of a check: no cases; ``needs`` says by load case what reaches the solver."""
    record = {name: value for name, value in results_json(results).items() if name not in NOT_OF_CHECKS}
    record["model"] = dict(record["model"]) | dict(MODEL.json(results))
    return record | {"needs": {case: dict(own.counts) | dict(NEEDS.json(own)) for case, own in needs.items()}}
