from argparse import Namespace
from pathlib import Path

import pytest

from mbla.errors import UsageError
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


def arguments(**changes: object) -> Namespace:
    texts = {"kind": None, "case": None, "view": "auto", "scale": "auto", "size": "1600x1000", "dpi": 100}
    return Namespace(**(texts | {"format": "png", "zoom": "auto", "output": None, "animate": None} | changes))


def test_kinds_come_in_their_own_order() -> None:
    assert parse_kinds("history, model") == ("model", "history")
    assert parse_kinds("all") == KINDS


def test_views_by_name_and_by_angle() -> None:
    assert parse_view("auto") is None
    assert parse_view("top") == VIEWS["top"]
    assert parse_view("-60,25") == (-60.0, 25.0)


def test_scale_and_size() -> None:
    assert (parse_scale("auto"), parse_scale("0"), parse_scale("2.5")) == (1.0, 0.0, 2.5)
    assert parse_size("800X500") == (800, 500)


def test_more_dots_for_each_inch_are_more_pixels() -> None:
    assert PictureOptions(size=(800, 500), dpi=300).pixels == (2400, 1500)


@pytest.mark.parametrize(
    ("parse", "text", "told"),
    [
        (parse_kinds, "model,force", "model, mechanism, forces, history, or all"),
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
    ],
)
def test_what_is_none_of_them_is_told(parse: object, text: str, told: str) -> None:
    with pytest.raises(UsageError, match=told):
        parse(text)  # type: ignore[operator]


def test_a_file_is_that_of_the_mechanism(tmp_path: Path) -> None:
    assert picture_options(arguments()).kinds == USUAL_KINDS
    assert picture_options(arguments(output=tmp_path)).kinds == USUAL_KINDS
    assert picture_options(arguments(output=Path("one.svg"))).kinds == ("mechanism",)
    assert picture_options(arguments(output=Path("one.svg"), kind="forces")).kinds == ("forces",)


def test_dots_per_inch_have_limits() -> None:
    with pytest.raises(UsageError, match="--dpi 0"):
        picture_options(arguments(dpi=0))
