"""What is odd about motions: mostly a unit, a baseline, or a time step; and what starts too late to act."""

from __future__ import annotations

import numpy as np

from mbla.deck.sections.motion import ForceHistorySection, MotionSection
from mbla.deck.sections.time_history import OF_PULSE, TimeHistorySection, motions_of
from mbla.errors import Finding, KeyPath, Notice
from mbla.model.loads.load_kind import LoadSite
from mbla.model.motion.record import Record
from mbla.model.motion.signal import Signal
from mbla.model.motion.time_history import TimeHistory
from mbla.model.wording import counted

STRONGEST, WEAKEST = 3.0, 1e-3
"""g, of base accelerations: no earthquake has more, and less moves no masonry"""
COARSEST = 0.1
"""s, between samples of a motion"""
LEFT_OVER = 0.05
"""of the peak velocity, at the end of a record"""
AT_ITS_END = 0.99
"""of the peak displacement, at the end of a record"""
CORRECTED = 0.05
"""of the peak, by which a correction of the baseline changes accelerations: those of records are small errors"""
UNEVEN = 1e-3
"""difference of steps, relative to the longest"""
ROUNDING = 1e-9


def remark_on_record(
    section: MotionSection | ForceHistorySection, record: Record, factor: float, site: LoadSite
) -> None:
    """Uneven steps and jumps, and a unit of the header that is another."""
    steps = record.steps
    uneven = float(np.ptp(steps)) > UNEVEN * float(steps.max())
    if uneven or record.jumps:
        jumps = f", with {counted(record.jumps, 'jump')} where a time is there twice" * (record.jumps > 0)
        words = f"{section.file}: its steps are {steps.min():.4g} to {steps.max():.4g} s{jumps}: values are linear in"
        site.selection.remark(Notice("notice", "motion-uneven", f"{words} between, which is followed exactly"))
    if isinstance(section, MotionSection) and float(np.median(steps)) > COARSEST:
        words = f"{section.file}: its samples are {np.median(steps):.4g} s apart: times are in seconds"
        site.warn("motion-unit", words)
    of_header = {"g": "g", "gal": "cm/s2", "gals": "cm/s2"}.get(record.unit, record.unit)
    if isinstance(section, MotionSection) and of_header in ("g", "cm/s2", "cm/s/s", "m/s2"):
        there = site.units.convert(f"1 {of_header.replace('/s/s', '/s2')}", "base_acceleration")
        if abs(there - factor) > ROUNDING * factor:
            words = f"{section.file}: its header says that values are in {of_header}, the deck {section.unit}"
            site.warn("motion-unit", f"{words}: unit: {of_header}?")


def judge_what_acts(
    moves: MotionSection | ForceHistorySection,
    signal: Signal,
    section: TimeHistorySection,
    path: KeyPath,
    site: LoadSite,
) -> None:
    """Tells of a motion, or a force, without size; leaves a fault where the duration ends before it starts."""
    if moves.scale == 0.0:
        what = f"pulse {moves.pulse}" if isinstance(moves, MotionSection) and moves.pulse else str(moves.file)
        site.selection.remark(Notice("notice", "motion-scale", f"{what}: its scale is 0, so that nothing of it acts"))
    begin = float(signal.times[0])
    if section.duration is not None and begin >= section.duration:
        words = f"it starts at {begin:g} s, but the time history ends at {section.duration:g} s and nothing of it acts"
        words += ": give a longer duration, or an earlier start"
        key = "start" if moves.start > 0.0 else "file"
        site.refuse(Finding("time-history-without-effect", words, *path, key))


def remark_on_motion(
    words: str,
    peak: float,
    site: LoadSite,
    raw: Signal | None = None,
    corrected: Signal | None = None,
    scale: float = 1.0,
) -> None:
    """A peak that no base has, before its scale, and a baseline that carries the base away, or takes much to correct.

    raw, corrected : of a record before its scale, the same where its baseline is not corrected
    """
    in_g = peak / site.units.standard_gravity
    if not WEAKEST <= in_g <= STRONGEST:
        what = "stronger than any earthquake" if in_g > STRONGEST else "too weak to move masonry"
        site.warn("motion-unit", f"{words}: its peak before scale is {in_g:.3g} g, {what}: unit?")
    if raw is None or corrected is None:
        return
    if corrected is raw:
        _remark_on_baseline(words, raw.times_factor(scale), site)
    else:
        _remark_on_correction(words, raw.times_factor(scale), corrected.times_factor(scale), site)


def _remark_on_baseline(words: str, raw: Signal, site: LoadSite) -> None:
    """A base that does not come to rest, or is farthest away at the end."""
    end = raw.times[-1]
    velocity, displacement = abs(float(raw.integral(end))), abs(float(raw.second_integral(end)))
    remedy = "may be meant, a pulse leaves the base displaced; else baseline: linear or highpass brings it to rest"
    if velocity > LEFT_OVER * raw.peak_integral:
        share = f"{velocity / raw.peak_integral:.0%} of its greatest"
        site.warn("motion-baseline", f"{words}: the velocity at its end is {share}: {remedy}")
    elif displacement > AT_ITS_END * raw.peak_second_integral:
        size = f"{displacement:.3g} {site.units.length}"
        site.warn("motion-baseline", f"{words}: it drifts, its displacement is greatest at its end, {size}: {remedy}")


def _remark_on_correction(words: str, raw: Signal, corrected: Signal, site: LoadSite) -> None:
    """A correction that changes accelerations by more than a small share of the peak: it makes another motion."""
    change = float(np.abs(corrected.value(corrected.times) - raw.value(corrected.times)).max())
    if change > CORRECTED * raw.peak:
        by, before, after = (
            f"{each / site.units.standard_gravity:.3g} g" for each in (change, raw.peak, corrected.peak)
        )
        says = f"its baseline changes accelerations by up to {by}, {change / raw.peak:.0%} of the peak, which goes"
        says += f" from {before} to {after}"
        site.warn("motion-baseline-large", f"{words}: {says}: if the base is left displaced, baseline: none")


def remark_on_history(name: str, section: TimeHistorySection, built: TimeHistory, site: LoadSite) -> None:
    """Its step, its duration, and states that are kept."""
    _remark_on_step(name, section, built, site)
    _remark_on_duration(name, built, site)
    _remark_on_states(name, section, built, site)


def _remark_on_step(name: str, section: TimeHistorySection, built: TimeHistory, site: LoadSite) -> None:
    """A time step that passes over samples of a record, or is long for a pulse."""
    if section.step is None:
        return
    for each in built.drivers:
        least = each.signal.usual_step
        if each.source and section.step > least * (1.0 + UNEVEN):
            words = f"{name}: step {section.step:g} s is above that of {each.source}, {least:.4g} s"
            site.warn(
                "motion-step", f"{words}: what is between is followed by its impulse alone; use step: {least:.4g}"
            )
    for motion in motions_of(section):
        if motion.duration is not None and section.step > motion.duration / OF_PULSE * (1.0 + ROUNDING):
            least = motion.duration / OF_PULSE
            words = f"{name}: step {section.step:g} s is above a hundredth of the pulse of {motion.duration:g} s"
            site.warn("motion-step", f"{words}: impacts within it come late; use step: {least:.4g}")


def _remark_on_duration(name: str, built: TimeHistory, site: LoadSite) -> None:
    """Records that end before the time history does, or after it."""
    files = [each for each in built.drivers if each.source]
    ends = max(float(each.signal.times[-1]) for each in built.drivers)
    left = built.duration - ends
    if left < -ROUNDING * ends:
        words = f"{name}: duration {built.duration:g} s leaves out the last {-left:.4g} s of the motion"
        site.selection.remark(Notice("notice", "motion-ends", words))
    elif files and left > ROUNDING * ends:
        words = f"{name}: the motion ends at {ends:.4g} s: in the last {left:.4g} s the structure moves freely"
        site.selection.remark(Notice("notice", "motion-ends", words))


def _remark_on_states(name: str, section: TimeHistorySection, built: TimeHistory, site: LoadSite) -> None:
    """States that are to be kept more often than there are steps."""
    every = section.record.every
    if every is not None and every < built.step * (1.0 - ROUNDING):
        words = (
            f"{name}: record.every {every:g} s is below the step of {built.step:g} s: one state is kept for each step"
        )
        site.selection.remark(Notice("notice", "record-every", words))
