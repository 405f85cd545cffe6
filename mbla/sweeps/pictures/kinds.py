"""Kinds of pictures of a sweep; another one is a file and a line here."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from mbla.results.pictures.options import PictureOptions
from mbla.sweeps.pictures import curve, distribution, map, polar, scatter, tornado
from mbla.sweeps.pictures.view import View


@dataclass(frozen=True)
class Kind:
    """A kind of picture.

    refusal : why a table does not fit it, in words; empty where it does
    usual   : whether it is drawn of a table without being asked for
    draw    : writes it; raises as ``mbla.results.pictures.page.open_page`` does
    """

    refusal: Callable[[View], str]
    usual: Callable[[View], bool]
    draw: Callable[[Path, View, PictureOptions], None]


KINDS = {
    "curve": Kind(curve.refusal, curve.usual, curve.draw),
    "map": Kind(map.refusal, map.usual, map.draw),
    "polar": Kind(polar.refusal, polar.usual, polar.draw),
    "scatter": Kind(scatter.refusal, scatter.usual, scatter.draw),
    "distribution": Kind(distribution.refusal, distribution.usual, distribution.draw),
    "tornado": Kind(tornado.refusal, tornado.usual, tornado.draw),
}
"""by name, in the order in which they are made"""
