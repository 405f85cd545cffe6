"""What ``mbla check --json`` tells: the record of a run without results, and what reaches the solver."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from mbla.contacts.contacts import ContactReport
from mbla.results.provenance import CaseNeeds
from mbla.results.quantities.group import Field, count
from mbla.results.record.case_parts import REDUCTION
from mbla.results.record.json_record import results_json
from mbla.results.record.objects import Object, json_of
from mbla.results.results import Results


@dataclass(frozen=True)
class JointUse:
    """Interfaces of a joint law, and their area."""

    interfaces: int
    area: float


MODEL, JOINT, NEEDS = Object[Results](), Object[JointUse](), Object[CaseNeeds]()
_REPORT = MODEL.of(lambda results: results.contacts.report)


@MODEL.key("a load case")
def load_cases(results: Results) -> list[str]:
    """`mbla check`: names of the load cases."""
    return [case.name for case in results.model.load_cases]


@MODEL.key("a joint law", inside=JOINT)
def joints(results: Results) -> dict[str, JointUse]:
    """`mbla check`: joint laws in use."""
    return {name: JointUse(*use) for name, use in results.contacts.by_joint.items()}


JOINT.fields(JointUse, interfaces=Field("its interfaces"), area=Field("their area", unit="area"))
_REPORT.fields(
    ContactReport,
    slivers=Field("`mbla check`: common surfaces dropped as thinner than the tolerance", by=count),
    near_misses=Field("`mbla check`: near misses: pairs of bodies that nearly touch", by=count),
    overlaps=Field("`mbla check`: pairs of blocks that overlap", by=count),
)


@MODEL.key("a block")
def isolated_blocks(results: Results) -> list[str]:
    """`mbla check`: blocks without contact."""
    return [results.model.blocks.name(int(block)) for block in results.contacts.report.isolated]


_REPORT.fields(
    ContactReport,
    unsupported_parts=Field("`mbla check`: parts that reach no support", attribute="unsupported", by=count),
)
NEEDS.fields(
    CaseNeeds,
    reductions=Field(
        "what each reduction left out, in the order in which they are applied", items=("a reduction",), inside=REDUCTION
    ),
)
NOT_OF_CHECKS = ("cases", "series", "objectives", "files", "complete", "not_done")
"""keys of a run that a check has not"""


def check_json(results: Results, needs: Mapping[str, CaseNeeds]) -> dict[str, Any]:
    """The record of a check: no cases; ``needs`` says by load case what reaches the solver."""
    record = {name: value for name, value in results_json(results).items() if name not in NOT_OF_CHECKS}
    planar = bool(needs) and all(own.counts["dimension"] == 2 for own in needs.values())
    record["model"] = dict(record["model"]) | dict(json_of(MODEL, results)) | {"dimension": 2 if planar else 3}
    return record | {"needs": {case: dict(own.counts) | dict(json_of(NEEDS, own)) for case, own in needs.items()}}
