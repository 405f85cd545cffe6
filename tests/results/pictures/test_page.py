"""Pages and options of pictures."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import numpy.typing as npt
import pytest

from mbla.errors import FileError, UsageError
from mbla.results.pictures.options import (
    KINDS,
    USUAL_KINDS,
    VIEWS,
    PictureOptions,
    parse_kinds,
    parse_scale,
    parse_size,
    parse_view,
    picture_options,
)
from mbla.results.pictures.page import COLUMNS, add_legend, add_words, open_page

UInt8Array = npt.NDArray[np.uint8]
WIDTH, HEIGHT = PictureOptions().size

WORDS = ["Arch of $5 – 拱 <b>", "load case push_x: collapses at 0.5 g"]
LEGEND = [["hinge", "#D55E00"], ["live load", "#222222"]]
IMAGE = np.full((HEIGHT, WIDTH, 3), 255, dtype=np.uint8)


def write_page(path: Path, image: UInt8Array, words: list[str], legend: list[list[str]]) -> None:
    """Everything that a page can hold."""
    with open_page(path, PictureOptions()) as page:
        axes = page.figure.add_axes((0.0, 0.0, 1.0, 1.0))
        axes.imshow(image, aspect="auto", interpolation="none")
        axes.set_axis_off()
        add_words(page, words)
        add_legend(page, [page.box(name, color=colour) for name, colour in legend])


def test_png_has_the_pixels_of_the_image(tmp_path: Path) -> None:
    from PIL import Image

    path = tmp_path / "page.png"
    image = IMAGE.copy()
    image[400:600, 700:900] = (10, 20, 30)
    write_page(path, image, WORDS, LEGEND)
    with Image.open(path) as page:
        pixels = np.asarray(page.convert("RGB"))
    assert pixels.shape == image.shape
    assert (pixels[400:600, 700:900] == (10, 20, 30)).all()
    assert (pixels[300:400, 700:900] == 255).all()
    assert (pixels[:100] < 100).any(), "words above"
    assert (pixels[950:] < 100).any(), "legend below"
    assert (pixels[:, -5:] == 255).all(), "no word runs into the edge"


def test_words_of_an_svg_are_text(tmp_path: Path) -> None:
    path = tmp_path / "page.svg"
    write_page(path, IMAGE, WORDS, LEGEND)
    tree = ElementTree.parse(path)
    texts = [" ".join("".join(node.itertext()).split()) for node in tree.iter() if node.tag.endswith("}text")]
    assert texts == [*WORDS, "hinge", "live load"]
    assert sum(node.tag.endswith("}image") for node in tree.iter()) == 1


@pytest.mark.parametrize("suffix", ["png", "svg", pytest.param("pdf", marks=pytest.mark.long)])
def test_the_same_picture_gives_the_same_file(tmp_path: Path, suffix: str) -> None:
    paths = [tmp_path / f"{name}.{suffix}" for name in "ab"]
    for path in paths:
        write_page(path, IMAGE, WORDS, LEGEND)
    assert paths[0].read_bytes() == paths[1].read_bytes()
    assert paths[0].read_bytes().startswith({"png": b"\x89PNG", "svg": b"<?xml", "pdf": b"%PDF-"}[suffix])


def test_long_words_stay_on_the_page(tmp_path: Path) -> None:
    path = tmp_path / "page.svg"
    write_page(path, IMAGE, ["W " * 200], [])
    texts = [node for node in ElementTree.parse(path).iter() if node.tag.endswith("}text")]
    assert len(texts) > 2
    assert all(len("".join(text.itertext()).strip()) <= COLUMNS for text in texts)


def test_other_formats_and_places_are_refused(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="PNG, SVG or PDF"):
        write_page(tmp_path / "page.jpg", IMAGE, WORDS, LEGEND)
    with pytest.raises(FileError, match="No such file"):
        write_page(tmp_path / "missing" / "page.png", IMAGE, WORDS, LEGEND)


# --- Options --------------------------------------------------------------------------------------------------------


def arguments(**changes: object) -> Namespace:
    texts = {"kind": None, "case": None, "view": "auto", "scale": "auto", "size": "1600x1000", "dpi": 100}
    return Namespace(**(texts | {"format": "png", "output": None, "animate": None} | changes))


@pytest.mark.parametrize(
    ("parse", "text", "value"),
    [
        (parse_kinds, "history, model", ("model", "history")),
        (parse_kinds, "all", KINDS),
        (parse_view, "auto", None),
        (parse_view, "top", VIEWS["top"]),
        (parse_view, "-60,25", (-60.0, 25.0)),
        (parse_scale, "auto", 1.0),
        (parse_scale, "2.5", 2.5),
        (parse_size, "800X500", (800, 500)),
    ],
)
def test_options_as_texts(parse: Any, text: str, value: object) -> None:
    assert parse(text) == value


@pytest.mark.parametrize(
    ("parse", "text", "told"),
    [
        (parse_kinds, "model,force", "model, mechanism, forces, history, curve, or all"),
        (parse_kinds, "", "model, mechanism"),
        (parse_view, "bottom", "front, back"),
        (parse_view, "10,100", "AZIMUTH,ELEVATION"),
        (parse_view, "nan,0", "AZIMUTH,ELEVATION"),
        (parse_view, "10", "AZIMUTH,ELEVATION"),
        (parse_scale, "-1", "multiple"),
        (parse_scale, "inf", "multiple"),
        (parse_scale, "1e300", "to 1000"),
        (parse_scale, "big", "multiple"),
        (parse_size, "800", "width x height"),
        (parse_size, "10x10", "200 to 20000"),
        (parse_size, "800x500x3", "width x height"),
        (lambda dpi: picture_options(arguments(dpi=int(dpi))), "0", "--dpi 0"),
    ],
)
def test_what_is_none_of_them_is_told(parse: Any, text: str, told: str) -> None:
    with pytest.raises(UsageError, match=told):
        parse(text)


def test_a_file_is_that_of_the_mechanism(tmp_path: Path) -> None:
    assert picture_options(arguments()).kinds == USUAL_KINDS
    assert picture_options(arguments(output=tmp_path)).kinds == USUAL_KINDS
    assert picture_options(arguments(output=Path("one.svg"))).kinds == ("mechanism",)
    assert picture_options(arguments(output=Path("one.svg"), kind="forces")).kinds == ("forces",)
