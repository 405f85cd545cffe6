"""A time history from its section of the deck: motions, forces, what is recorded and what moves as one."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.deck.sections.motion import ForceHistorySection, MotionSection, is_at2, vector_of
from mbla.deck.sections.selectors import GROUND, Selector
from mbla.deck.sections.time_history import MOST_STEPS, OF_PULSE, STEP, TimeHistorySection, motions_of
from mbla.errors import DeckError, Finding, KeyPath
from mbla.model.applied_load import wrenches_of
from mbla.model.loads.load_kind import LoadSite
from mbla.model.loads.on_soil import refuse_on_cells
from mbla.model.motion.at2 import read_at2
from mbla.model.motion.baseline import high_passed, without_line
from mbla.model.motion.columns import read_columns
from mbla.model.motion.pulses import pulse_of
from mbla.model.motion.record import Record
from mbla.model.motion.remarks import (
    judge_what_acts,
    remark_on_history,
    remark_on_motion,
    remark_on_record,
)
from mbla.model.motion.signal import Signal
from mbla.model.motion.time_history import BaseMotion, ForceHistory, RecordedInterface, RecordedPoint, TimeHistory
from mbla.model.outside import outside
from mbla.model.selectors import select_blocks
from mbla.model.solids.plane import unit
from mbla.model.tables import TableRefused
from mbla.model.wording import named, vector

OFTEN, MOST_STATES = 0.01, 400
"""s between states that are kept unless the deck says, and how many there are at most then"""


def build_time_history(
    name: str, section: TimeHistorySection, levers: FloatArray, following: FloatArray, site: LoadSite
) -> TimeHistory | None:
    """The time history of a load case; None where a fault was left.

    levers, following : of its dead loads, as ``TimeHistory`` has them

    Refuses files that are no records, forces that move nothing, what starts after the end, points and interfaces of
    blocks that there are not, and kinematic blocks that are fixed or share a block.
    """
    path: KeyPath = ("load_cases", name, "time_history")
    before = len(site.selection.faults)
    motions = tuple(_motions(section, path, site))
    forces = tuple(_forces(section, path, site))
    points, interfaces = tuple(_points(section, path, site)), tuple(_interfaces(section, path, site))
    rigid = _rigid(name, section, path, site)
    _judge_fill(name, site)
    if len(site.selection.faults) > before or site.selection.partial:
        return None
    signals = [motion.signal for motion in motions] + [force.signal for force in forces]
    ends = max(float(signal.times[-1]) for signal in signals)
    duration = ends if section.duration is None else section.duration
    built = TimeHistory(
        motions=motions,
        forces=forces,
        step=_default_step(section, motions, signals) if section.step is None else section.step,
        duration=duration,
        damping=section.damping,
        contact_damping=section.contact_damping,
        every=max(OFTEN, duration / MOST_STATES) if section.record.every is None else section.record.every,
        points=points,
        interfaces=interfaces,
        stop_displacement=np.inf if section.stop.displacement is None else section.stop.displacement,
        stop_at_rest=section.stop.rest,
        stop_at_collapse=section.stop.collapse,
        rigid=rigid,
        check=section.check,
        dead_levers=levers,
        dead_following=following,
    )
    if built.duration / built.step > MOST_STEPS:
        words = f"{built.duration:g} s in steps of {built.step:.3g} s are {built.duration / built.step:.2g} steps: "
        words += f"{MOST_STEPS:,} can be followed; give step or duration"
        site.refuse(Finding("out-of-bounds", words, *path))
        return None
    remark_on_history(name, section, built, site)
    return built


def _default_step(section: TimeHistorySection, motions: tuple[BaseMotion, ...], signals: list[Signal]) -> float:
    """The usual one, or the step of a record, or a hundredth of the shortest pulse."""
    pulses = [each.duration / OF_PULSE for each in motions_of(section) if each.duration is not None]
    of_files = [motion.signal for motion in motions if motion.source] + signals[len(motions) :]
    return min([STEP, *pulses, *(signal.usual_step for signal in of_files)])


def _motions(section: TimeHistorySection, path: KeyPath, site: LoadSite) -> Iterator[BaseMotion]:
    for number, motion in enumerate(motions_of(section)):
        place: KeyPath = (*path, "motion", number) if isinstance(section.motion, list) else (*path, "motion")
        built = list(_pulse(motion, site) if motion.pulse is not None else _record(motion, place, site))
        for first in built[:1]:
            judge_what_acts(motion, first.signal, section, place, site)
        yield from built


def _pulse(motion: MotionSection, site: LoadSite) -> Iterator[BaseMotion]:
    assert motion.pulse is not None  # who calls knows
    assert motion.amplitude is not None  # rules of the deck, as the next two
    assert motion.duration is not None
    assert motion.direction is not None
    signal = pulse_of(motion.pulse, motion.duration).times_factor(motion.amplitude * motion.scale).later(motion.start)
    direction = unit(vector_of(motion.direction))
    words = (
        f"pulse {motion.pulse} of {_in_g(motion.amplitude * motion.scale, site)} for "
        f"{motion.duration:g} s along {vector(direction)}" + _from(motion.start)
    )
    remark_on_motion(words, motion.amplitude, site)
    yield BaseMotion(words, signal, direction)


def _record(motion: MotionSection, path: KeyPath, site: LoadSite) -> Iterator[BaseMotion]:
    assert motion.file is not None  # who calls knows
    record = _read(motion, path, site)
    if record is None:
        return
    assert motion.unit is not None  # a rule of the deck
    factor = site.units.convert(f"1 {motion.unit}", "base_acceleration")
    remark_on_record(motion, record, factor, site)
    given = [motion.direction] if motion.direction is not None else motion.directions or ["x", "y", "z"]
    count = record.values.shape[1]
    for column, along in zip(range(count), given, strict=False):
        raw = Signal(record.times, factor * record.values[:, column])
        corrected = _corrected(raw, motion, path, site)
        if corrected is None:
            return
        direction = unit(vector_of(along))
        signal = corrected.times_factor(motion.scale).later(motion.start)
        words = motion.file + (f", column {motion.columns[column - count]}" if motion.columns and count > 1 else "")
        words += f", times {motion.scale:g}" * (motion.scale != 1.0)
        words += f", baseline {motion.baseline}" * (motion.baseline != "none")
        words += f", along {vector(direction)}, peak {_in_g(signal.peak, site)}"
        remark_on_motion(words, raw.peak, site, raw, corrected, motion.scale)
        yield BaseMotion(words + _from(motion.start), signal, direction, motion.file)


def _in_g(acceleration: float, site: LoadSite) -> str:
    return f"{acceleration / site.units.standard_gravity:.6g} g"


def _from(start: float) -> str:
    return f", from {start:g} s" * (start > 0.0)


def _corrected(raw: Signal, motion: MotionSection, path: KeyPath, site: LoadSite) -> Signal | None:
    """The signal with its baseline corrected; None where a fault was left."""
    if motion.baseline == "none":
        return raw
    if motion.baseline == "linear":
        return without_line(raw)
    try:
        return high_passed(raw, motion.corner_or_usual)
    except ValueError as error:
        site.refuse(Finding("out-of-bounds", str(error), *path, "corner" if motion.corner is not None else "baseline"))
        return None


def _read(section: MotionSection | ForceHistorySection, path: KeyPath, site: LoadSite) -> Record | None:
    """The record of a file; None where a fault was left."""
    assert section.file is not None  # who calls knows
    here = (*path, "file")
    try:
        file = site.resolve_file(here, section.file)
        return read_at2(file) if is_at2(section.file) else read_columns(file, section.columns, section.interval)
    except DeckError as error:
        site.selection.faults.extend(error.faults)
    except TableRefused as refused:
        for finding in refused.findings(*here):
            site.refuse(finding)
    return None


def _forces(section: TimeHistorySection, path: KeyPath, site: LoadSite) -> Iterator[ForceHistory]:
    for number, force in enumerate(section.forces):
        place: KeyPath = (*path, "forces", number)
        block = _one_block(force.on, (*place, "on"), "force over time acts on", site)
        record = _read(force, place, site)
        if block is None or record is None or refuse_on_cells("force", np.array([block]), (*place, "on"), site):
            continue
        if site.fixed[block] and not site.fixed.all():
            words = f"{site.blocks.name(block)} does not move: the force goes straight into the support"
            site.refuse(Finding("time-history-without-effect", words, *place, "on"))
            continue
        remark_on_record(force, record, 1.0, site)
        direction, centroid = unit(vector_of(force.direction)), site.blocks.centroids[block]
        factor = force.scale * site.units.convert(f"1 {force.unit}", "force")
        signal = Signal(record.times, factor * record.values[:, 0]).later(force.start)
        judge_what_acts(force, signal, section, place, site)
        words = f"force of {force.file} along {vector(direction)} on {site.blocks.name(block)}"
        words += f", peak {signal.peak:.6g} {site.units.force}" + _from(force.start)
        point = centroid if force.at is None else np.array(force.at)
        _judge_outside(point, block, f"the {words}, acts", site)
        wrenches = np.zeros((len(site.blocks), 15))
        wrenches[block] = wrenches_of(direction[None], point[None], centroid[None])[0]
        yield ForceHistory(words, signal, wrenches, force.file)


def _judge_outside(point: FloatArray, block: int, words: str, site: LoadSite) -> None:
    off = outside(point, block, site.blocks, site.units)
    if off is not None:
        site.warn("force-outside-block", f"{words} at {vector(point)} {site.units.length}, {off.words}")


def _one_block(selector: Selector, path: KeyPath, what: str, site: LoadSite) -> int | None:
    """The block that a selector means; None where a fault was left."""
    blocks = select_blocks(selector, path, site.selection)
    if blocks is None:
        return None
    if len(blocks) == 1:
        return int(blocks[0])
    words = f"a {what} one block, {len(blocks)} are selected: give an index, or an entry for each"
    site.refuse(Finding("one-block-only", words, *path))
    return None


def _points(section: TimeHistorySection, path: KeyPath, site: LoadSite) -> Iterator[RecordedPoint]:
    for name, point in section.record.points.items():
        place: KeyPath = (*path, "record", "points", name, "on")
        block = _one_block(point.on, place, "point moves with", site)
        if block is None:
            continue
        where = site.blocks.centroids[block] if point.at is None else np.array(point.at)
        off = outside(where, block, site.blocks, site.units)
        if off is not None:
            words = f"the recorded point {name} at {vector(where)} {site.units.length} lies {off.words}"
            site.warn("recorded-point-outside", f"{words}; it moves with {site.blocks.name(block)}")
        yield RecordedPoint(name, block, where)


def _interfaces(section: TimeHistorySection, path: KeyPath, site: LoadSite) -> Iterator[RecordedInterface]:
    for name, asked in section.record.interfaces.items():
        place: KeyPath = (*path, "record", "interfaces", name, "between")
        sides = [_bodies(selector, (*place, side), site) for side, selector in enumerate(asked.between)]
        if sides[0] is None or sides[1] is None:
            continue
        if sides[0] == sides[1]:
            words = "is the block on the other side: an interface lies between two"
            site.refuse(Finding("recorded-interface-missing", words, *place, 1))
            continue
        pairs = [(first, second) for first in sides[0] for second in sides[1]]
        for number, pair in enumerate(pairs):
            yield RecordedInterface(f"{name}[{number}]" if len(pairs) > 1 else name, np.array(pair))


def _bodies(selector: Selector, path: KeyPath, site: LoadSite) -> list[int] | None:
    """The block that a side of an interface means, or every ground; None where a fault was left."""
    if selector != GROUND:
        block = _one_block(selector, path, "side of an interface is", site)
        return None if block is None else [block]
    if site.grounds:
        return [len(site.blocks) + number for number in range(len(site.grounds))]
    words = "there is no ground: the supports are blocks, name one"
    site.refuse(Finding("recorded-interface-missing", words, *path))
    return None


def _rigid(name: str, section: TimeHistorySection, path: KeyPath, site: LoadSite) -> tuple[IntArray, ...]:
    """Blocks of each kinematic block of several."""
    found = list[IntArray]()
    owner = dict[int, int]()
    for number, selector in enumerate(section.rigid):
        place: KeyPath = (*path, "rigid", number)
        blocks = select_blocks(selector, place, site.selection)
        if blocks is None:
            continue
        still, twice = blocks[site.fixed[blocks]], [block for block in blocks.tolist() if block in owner]
        if len(still):
            words = f"fixed: {named(still, site.blocks.name)}; what moves as one has no block that does not move"
            site.refuse(Finding("rigid-blocks", words, *place))
        elif twice:
            names = named(np.array(twice), site.blocks.name)
            words = f"{names}: rigid[{owner[twice[0]]}] has it already; a block moves with one kinematic block"
            site.refuse(Finding("rigid-blocks", words, *place))
        elif len(blocks) < 2:
            site.warn("rigid-alone", f"{name}: rigid[{number}] is one block, {named(blocks, site.blocks.name)}, alone")
        else:
            found.append(blocks)
        owner |= dict.fromkeys(blocks.tolist(), number)
    return tuple(found)


def _judge_fill(name: str, site: LoadSite) -> None:
    """Fill on blocks is a mass that goes along with them."""
    for body in site.fill.values():
        if body.passive is not None:
            words = f"does not go with load case {name}, in whose time history fill acts by its mass: leave it out"
            site.refuse(Finding("time-history-not-possible", words, "fill", body.name, "passive"))
            continue
        words = f"{name}: the fill {body.name} goes along with its blocks by weight and mass; nothing else of it is"
        site.warn("fill-in-time", f"{words} followed in time, and loads through it stay where they land")
