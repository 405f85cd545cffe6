"""Moving pictures of a mechanism, GIF or MP4, off and back (only importer of imageio-ffmpeg, an extra).

Every frame moves the blocks by finite rotations that keep their shape (:mod:`mbla.results.collapse.motion`). The motion
swings as a cosine and ends where it began: the film repeats without a jump. The view, the room for words and the legend
are those of the widest frame.
"""

from __future__ import annotations

import io
import tempfile
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from mbla.arrays import evenly
from mbla.errors import FileError, UsageError
from mbla.results.collapse.motion import end_motion, history_motion, pushed_motions
from mbla.results.pictures.drawing import draw_on, drawing_of, extent_of
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import open_frames
from mbla.results.pictures.scene import PictureScene, scene_of
from mbla.results.results import CaseResult, Results
from mbla.solution.time_history.history import TimeHistoryResult

FORMATS = ("gif", "mp4")
STEPS = 12
"""from rest to the greatest displacement"""
FRAMES_PER_SECOND = 12
MOST_FRAMES = 60
"""of a pushover, steps evenly chosen"""
MOST_IN_TIME = 180
"""of a structure in time: fifteen seconds of a film; what takes longer goes by faster"""
LARGEST = {"gif": (800, 500), "mp4": (1280, 800)}
"""pixels of a frame; a GIF keeps every one of them in 256 colours, and is for slides and pages"""
COLOURS = 128
"""of a GIF, the same in every frame, so that what is at rest does not flicker"""


def format_of_film(path: Path) -> str:
    """``gif`` or ``mp4`` by the name of a file; raises UsageError for any other."""
    suffix = path.suffix.lower().removeprefix(".")
    if suffix not in FORMATS:
        raise UsageError("output-format", f"{path}: animations are written as GIF or MP4, by the name of the file")
    return suffix


def write_animation(results: Results, case: CaseResult, path: Path, options: PictureOptions | None = None) -> None:
    """The mechanism of one load case as a GIF or MP4 that repeats, or by the kind ``curve`` the steps of its pushover.

    A structure that was followed in time moves as it did, true to scale, in its own time where that is not too long.

    The same result gives the same GIF.

    Frames have the shape of ``options.size`` and at most the pixels of ``LARGEST``.

    Raises
    ------
    UsageError
        The case has no motion to show, the extra for pictures is not installed, the machine has no OpenGL, or the name
        asks for another format.
    FileError
        The file cannot be written.
    """
    kind = format_of_film(path)
    if not path.parent.is_dir():
        raise FileError("file-missing", f"{path.parent}: no such folder")  # said before the frames are drawn
    options = fitted_options(options or PictureOptions(), kind)
    widest = scene_of(results, case, options, "mechanism")
    if not widest.motion.any():
        raise UsageError(
            "no-mechanism", f"load case {case.load_case.name}: there is no mechanism, so there is nothing to animate"
        )
    pushed = pushed_motions(case) if "curve" in options.kinds else []
    if pushed:
        shown = evenly(len(pushed), MOST_FRAMES)
        scenes = [replace(widest, drawn=pushed[step]) for step in shown]
        film = list(_frames([widest, *scenes[-1:]], scenes, options))
        film += film[-1:] * (FRAMES_PER_SECOND // 2)
    elif case.solution.further.time_history.frames is not None:
        scenes = _in_time(widest, case.solution.further.time_history, options.scale)
        farthest = max(scenes, key=lambda scene: float(np.abs(scene.drawn).max(initial=0.0)))
        film = list(_frames([farthest, scenes[0]], scenes, options))
        film += film[-1:] * (FRAMES_PER_SECOND // 2)
    else:
        forth = list(_frames([widest], (widest.moved_to(share * options.scale) for share in displacements()), options))
        film = [*forth, *forth[-2:0:-1]]
    image = _gif(film) if kind == "gif" else _mp4(film)
    try:
        path.write_bytes(image)
    except OSError as error:
        raise FileError("file-not-written", f"{path}: {error.strerror or error}") from error


def _in_time(widest: PictureScene, found: TimeHistoryResult, scale: float) -> list[PictureScene]:
    """States of a structure in time, as many as a film in its own time has, at most ``MOST_IN_TIME``, and its end."""
    frames = found.frames
    assert frames is not None  # asked for where there are
    seconds = float(frames.times[-1] - frames.times[0])
    most = min(MOST_IN_TIME, max(round(seconds * FRAMES_PER_SECOND), 2))
    how = "" if scale == 1.0 else f", {scale:g} times its displacements"
    shown = [(float(frames.times[state]), history_motion(frames, state)) for state in evenly(len(frames), most)]
    end = end_motion(found)
    return [
        replace(widest, drawn=scale * motion, moment=f"at {time:.2f} s{how}")
        for time, motion in (shown if end is None else [*shown, end])
    ]


def fitted_options(options: PictureOptions, kind: str) -> PictureOptions:
    """The same shape in at most the pixels of a film, both sides even, as MP4 wants them; words keep their share."""
    width, height = options.pixels
    most_wide, most_high = LARGEST[kind]
    share = min(1.0, most_wide / width, most_high / height)
    return replace(options, size=(2 * round(width * share / 2), 2 * round(height * share / 2)), dpi=100)


def displacements(steps: int = STEPS) -> Any:
    """Shares of the greatest displacement from rest to it, (steps + 1,): slow at both ends."""
    return (1 - np.cos(np.pi * np.arange(steps + 1) / steps)) / 2


def _frames(widest: Sequence[PictureScene], scenes: Iterable[PictureScene], options: PictureOptions) -> Iterator[Any]:
    """Images (height, width, 3) of 0 to 255 of scenes, none of which goes beyond the widest."""
    drawing = drawing_of(widest[0], "mechanism", options.view)
    extent = extent_of(widest, drawing)
    for scene in scenes:
        with open_frames(options) as page:
            draw_on(page, scene, drawing, "mechanism", extent)
            page.figure.canvas.draw()
            yield np.asarray(page.figure.canvas.buffer_rgba())[..., :3].copy()


def _gif(film: list[Any]) -> bytes:
    """One palette for the entire film, from its first and its widest frame."""
    from PIL import Image  # comes with matplotlib

    both = np.concatenate([film[0], film[len(film) // 2]])
    palette = Image.fromarray(both).quantize(COLOURS, method=Image.Quantize.MEDIANCUT)
    images = [Image.fromarray(frame).quantize(palette=palette, dither=Image.Dither.NONE) for frame in film]
    target = io.BytesIO()
    duration = round(1000 / FRAMES_PER_SECOND)
    images[0].save(target, "GIF", save_all=True, append_images=images[1:], duration=duration, loop=0, optimize=False)
    return target.getvalue()


def _mp4(film: list[Any]) -> bytes:
    """H.264 as browsers and slides play it."""
    try:
        import imageio_ffmpeg
    except ImportError as error:
        raise UsageError(
            "extra-missing", "MP4 needs an extra that is not installed: pip install 'mbla[pictures]'"
        ) from error
    height, width = film[0].shape[:2]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "film.mp4"
        writer = imageio_ffmpeg.write_frames(
            str(path), (width, height), fps=FRAMES_PER_SECOND, quality=8, macro_block_size=2, ffmpeg_log_level="error"
        )
        writer.send(None)
        try:
            for frame in (*film, *film):  # two swings: one is over before it is seen, and players do not repeat
                writer.send(np.ascontiguousarray(frame))
        finally:
            writer.close()
        return path.read_bytes()
