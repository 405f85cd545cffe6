import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mbla.errors import FileError, UsageError
from mbla.results.pictures.animation import FRAMES_PER_SECOND, displacements, fitted_options, write_animation
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.plot import plot_results
from mbla.results.results import Results
from tests.results.opengl import needs_opengl
from tests.results.synthetic import tower_results

pytestmark = pytest.mark.long

SMALL = PictureOptions(size=(200, 202), view=(-60.0, 25.0))


SHORT = 4
"""steps of the films drawn here"""


@pytest.fixture
def short(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mbla.results.pictures.animation.displacements", lambda: displacements(SHORT))


@pytest.fixture(scope="module")
def results() -> Results:
    return tower_results()


def test_frames_lead_from_rest_to_the_greatest_displacement_slowly_at_both_ends() -> None:
    shares = displacements(12)
    assert shares[0] == 0.0
    assert shares[-1] == pytest.approx(1.0)
    steps = np.diff(shares)
    assert (steps > 0).all()
    assert steps[0] == pytest.approx(steps[-1])
    assert steps[0] < steps[6] / 2


@pytest.mark.parametrize(
    ("size", "kind", "pixels"),
    [((1600, 1000), "gif", (800, 500)), ((400, 301), "gif", (400, 300)), ((3000, 1000), "mp4", (1280, 426))],
)
def test_frames_have_the_shape_asked_for_and_even_sides(
    size: tuple[int, int], kind: str, pixels: tuple[int, int]
) -> None:
    assert fitted_options(PictureOptions(size=size), kind).pixels == pixels


@needs_opengl
@pytest.mark.usefixtures("short")
def test_a_gif_swings_there_and_back_and_is_the_same_every_time(tmp_path: Path, results: Results) -> None:
    from PIL import Image, ImageSequence

    paths = [tmp_path / "a.gif", tmp_path / "b.gif"]
    for path in paths:
        write_animation(results, results.cases[0], path, SMALL)
    assert paths[0].read_bytes() == paths[1].read_bytes()
    with Image.open(paths[0]) as film:
        frames = [np.asarray(frame.convert("RGB")).astype(int) for frame in ImageSequence.Iterator(film)]
        assert film.info["loop"] == 0
        assert film.info["duration"] == pytest.approx(1000 / FRAMES_PER_SECOND, abs=10)
    assert len(frames) == 2 * SHORT
    assert frames[0].shape == (202, 200, 3)
    away = [float(np.abs(frame - frames[0]).mean()) for frame in frames]
    assert int(np.argmax(away)) == SHORT
    assert np.abs(frames[SHORT - 1] - frames[SHORT + 1]).max() == 0


@needs_opengl
@pytest.mark.usefixtures("short")
@pytest.mark.filterwarnings("ignore:unclosed file:ResourceWarning")  # of imageio-ffmpeg
def test_an_mp4_plays_with_its_frames_and_size(tmp_path: Path, results: Results) -> None:
    import imageio_ffmpeg

    path = tmp_path / "a.mp4"
    write_animation(results, results.cases[0], path, SMALL)
    frames = imageio_ffmpeg.read_frames(str(path))
    width, height = next(frames)["size"]
    film = np.array([np.frombuffer(frame, np.uint8).reshape(height, width, 3) for frame in frames])
    assert film.shape == (4 * SHORT, 202, 200, 3)
    assert np.abs(film[SHORT].astype(int) - film[0]).max() > 100
    assert np.abs(film[2 * SHORT].astype(int) - film[0]).max() < 30


def test_other_names_and_cases_at_rest_are_refused(tmp_path: Path, results: Results) -> None:
    with pytest.raises(UsageError, match="GIF or MP4"):
        write_animation(results, results.cases[0], tmp_path / "a.avi", SMALL)
    still = replace(results.cases[1], solution=replace(results.cases[1].solution, certificate=None))
    with pytest.raises(UsageError, match="nothing to animate"):
        write_animation(results, still, tmp_path / "a.gif", SMALL)
    with pytest.raises(UsageError, match="nothing moves"):
        plot_results(replace(results, cases=(still,)), tmp_path, "tower", replace(SMALL, animate="gif"))
    with pytest.raises(UsageError, match=r"ends in \.gif"):
        plot_results(results, tmp_path / "a.mp4", "tower", replace(SMALL, animate="gif", case="push_x"))
    assert not list(tmp_path.iterdir())


def test_a_place_that_cannot_be_written(tmp_path: Path, results: Results) -> None:
    with pytest.raises(FileError, match="missing"):
        write_animation(results, results.cases[0], tmp_path / "missing" / "a.gif", SMALL)


@needs_opengl
@pytest.mark.usefixtures("short")
def test_mp4_without_its_extra_says_what_to_install(
    tmp_path: Path, results: Results, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(UsageError, match=r"MP4 needs an extra .* pip install 'mbla\[pictures\]'"):
        write_animation(results, results.cases[0], tmp_path / "a.mp4", SMALL)
    assert not list(tmp_path.iterdir())
