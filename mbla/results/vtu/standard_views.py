"""Standard views of this result in ParaView 5.10 or newer; written by mbla next to the files that it shows.

In ParaView: Tools > Python Shell > Run Script. It opens a tab for each view, of the first load case; where ParaView
does not give a script its folder, call os.chdir(folder of the results) in the shell before. By itself:

    pvpython SCRIPT --case NAME --view mechanism                       a window; q closes it
    pvbatch --force-offscreen-rendering SCRIPT --save pictures         every view of every load case as PNG
    pvbatch --force-offscreen-rendering SCRIPT --case NAME --save .    those of one load case

Views: structure (blocks by group, supports), mechanism (blocks by the part that they move with, hinges, sliding, ghost
of the structure), thrust (resultant of each interface, thrust lines by eccentricity), utilisation (shear and torsion
over what the joint carries of both), loads (dead, live, reactions), animation (the mechanism with finite rotations),
pushed (the steps of a pushover), history (a structure in time).
"""

from __future__ import annotations

import argparse
import sys
import textwrap
from collections.abc import Callable
from pathlib import Path
from typing import Any

import paraview
from paraview import simple

RESULT: dict[str, Any] = {}
"""what this result is: filled in by mbla"""

SIZE = [1600, 1000]
INK, STONE, GREY = [0.15, 0.15, 0.15], [0.88, 0.85, 0.78], [0.62, 0.62, 0.62]
BLUE, ORANGE, RED, GREEN = [0.0, 0.45, 0.70], [0.90, 0.62, 0.0], [0.84, 0.37, 0.0], [0.0, 0.62, 0.45]
PALETTE = [[0.34, 0.71, 0.91], ORANGE, GREEN, [0.94, 0.89, 0.26], BLUE, RED, [0.80, 0.47, 0.65], [0.5, 0.5, 0.5]]
"""colours after Okabe and Ito, which the colour-blind can tell apart"""
MOST_NAMES = 12
"""groups up to this number are named next to the picture"""


class Picture:
    """One view of one load case: its sources and how they are drawn."""

    def __init__(self, case: str, name: str, folder: Path) -> None:
        self.case = RESULT["cases"][case]
        self.folder = folder
        self.length: float = RESULT["size"]
        self.view = simple.CreateView("RenderView")
        if paraview.fromGUI:
            simple.AssignViewToLayout(view=self.view, layout=simple.CreateLayout(name))
        self.view.ViewSize = SIZE
        _set(self.view, UseColorPaletteForBackground=0, Background=[1.0, 1.0, 1.0], OrientationAxesLabelColor=INK)
        self.sources: list[Any] = []
        self.legend: list[str] = []

    def read(self, kind: str) -> Any:
        """A file of the load case, or of all of them."""
        name = RESULT["supports"] if kind == "supports" else self.case["files"][kind]
        return self.keep(simple.XMLUnstructuredGridReader(FileName=[str(self.folder / name)]))

    def keep(self, source: Any) -> Any:
        """Updated, and deleted with the picture."""
        source.UpdatePipeline()
        self.sources.append(source)
        return source

    def draw(self, source: Any, kind: str = "Surface", colour: list[float] = STONE, **properties: Any) -> Any:
        """Show a source in one colour."""
        shown = simple.Show(source, self.view)
        shown.SetRepresentationType(kind)
        shown.ColorArrayName = [None, ""]
        _set(shown, AmbientColor=colour, DiffuseColor=colour, EdgeColor=INK, Ambient=0.3, **properties)
        return shown

    def around(self, opacity: float = 0.25) -> None:
        """Edges of the blocks as built, if any are to be seen, and ground planes; other supports are blocks."""
        if opacity:
            self.draw(self.read("blocks"), "Wireframe", GREY, Opacity=opacity)
        if RESULT["supports"]:
            self.draw(self.cells_with(self.read("supports"), "kind", 0), "Surface", GREY, Opacity=0.6)

    def cells_with(self, source: Any, name: str, value: int) -> Any:
        """Cells with a value."""
        chosen = simple.Threshold(Input=source, Scalars=["CELLS", name])
        chosen.LowerThreshold = chosen.UpperThreshold = value
        chosen.ThresholdMethod = "Between"
        return self.keep(chosen)

    def warped(self, source: Any) -> Any:
        """Moved with the mechanism as drawn."""
        return self.keep(simple.WarpByVector(Input=source, Vectors=["POINTS", "displacement"], ScaleFactor=1.0))

    def rods(self, source: Any, radius: float = 0.003) -> Any:
        """Lines as rods, with a radius relative to the structure."""
        surface = self.keep(simple.ExtractSurface(Input=source))
        return self.keep(simple.Tube(Input=surface, Radius=radius * self.length, NumberofSides=12))

    def arrows(self, source: Any, name: str, share: float, at_tip: bool) -> Any:
        """Vectors as arrows, the longest a share of the structure, with their tail or their tip at the point."""
        longest = source.PointData[name].GetRange(-1)[1]
        glyph = simple.Glyph(Input=source, GlyphType="Arrow")
        glyph.OrientationArray = glyph.ScaleArray = ["POINTS", name]
        glyph.GlyphMode = "All Points"
        glyph.ScaleFactor = share * self.length / longest if longest > 0 else 0.0
        if at_tip:
            glyph.GlyphTransform.Translate = [-1.0, 0.0, 0.0]
        return self.keep(glyph)

    def colour(self, shown: Any, where: str, name: str, title: str) -> None:
        """By a number from 0 to 1, with its bar."""
        simple.ColorBy(shown, (where, name))
        table = simple.GetColorTransferFunction(name)
        table.ApplyPreset("Viridis (matplotlib)", True)
        table.InvertTransferFunction()
        table.RescaleTransferFunction(0.0, 1.0)
        table.NanColor = GREY
        self.bar(shown, table, title)

    def colour_by_number(self, shown: Any, name: str, names: list[str], first: list[list[float]]) -> None:
        """By an integer of each cell; colours repeat where there are many."""
        simple.ColorBy(shown, ("CELLS", name))
        table = simple.GetColorTransferFunction(name)
        table.InterpretValuesAsCategories = table.AnnotationsInitialized = 1
        table.Annotations = [text for i, label in enumerate(names) for text in (str(i), label)]
        colours = first + [PALETTE[i % len(PALETTE)] for i in range(len(names) - len(first))]
        table.IndexedColors = [part for colour in colours[: len(names)] for part in colour]
        if len(names) <= MOST_NAMES:
            self.bar(shown, table, name)

    def bar(self, shown: Any, table: Any, title: str) -> None:
        """The bar or list of colours."""
        bar = simple.GetScalarBar(table, self.view)
        _set(bar, Title=title, ComponentTitle="", TitleColor=INK, LabelColor=INK, TitleFontSize=20, LabelFontSize=20)
        _set(bar, WindowLocation="Lower Right Corner")
        shown.SetScalarBarVisibility(self.view, True)

    def by_part(self, source: Any, **properties: Any) -> None:
        """Blocks by the part that they move with."""
        parts = ["at rest", *(f"part {i + 1}" for i in range(self.case["parts"]))]
        self.colour_by_number(self.draw(source, "Surface With Edges", **properties), "parts", parts, [STONE])

    def finish(self) -> None:
        """Words, and the camera on all that is shown, with room above it for them."""
        lines = [line for text in (*self.case["words"], *self.legend) for line in textwrap.wrap(text, 100)]
        shown = simple.Show(self.keep(simple.Text(Text="\n".join(lines))), self.view)
        _set(shown, Color=INK, FontSize=22, WindowLocation="Upper Left Corner", Justification="Left")
        self.view.CameraParallelProjection = 1
        self.view.CameraFocalPoint = [0.0, 0.0, 0.0]
        self.view.CameraPosition = self.case["look_from"]
        self.view.CameraViewUp = [0.0, 0.0, 1.0]
        simple.ResetCamera(self.view)
        self.view.GetActiveCamera().Zoom(1.0 - 0.06 * len(lines))
        simple.Render(self.view)

    def close(self) -> None:
        """Free what it holds."""
        for source in reversed(self.sources):
            simple.Delete(source)
        simple.Delete(self.view)


def structure(picture: Picture) -> None:
    """Blocks by group, and supports."""
    shown = picture.draw(picture.read("blocks"), "Surface With Edges")
    picture.colour_by_number(shown, "groups", RESULT["groups"], [])
    picture.around(0.0)


def mechanism(picture: Picture) -> None:
    """Blocks by the part that they move with, hinges and sliding joints, ghost of the structure."""
    picture.by_part(picture.warped(picture.read("blocks")), Opacity=0.85)
    picture.around()
    picture.legend = ["Displacements to a scale that can be seen; thin grey lines: as built."]
    if "hinges" in picture.case["files"]:
        hinges = picture.warped(picture.read("hinges"))
        picture.draw(picture.rods(hinges, 0.005), "Surface", RED)
        picture.draw(hinges, "Points", RED, PointSize=10.0, RenderPointsAsSpheres=1)
        picture.legend.append("Red rods: hinges; dots: their ends, alone for hinges about a corner.")
    interfaces = picture.case["files"].get("interfaces")
    if interfaces and picture.case["slides"]:
        sliding = picture.warped(picture.cells_with(picture.read("interfaces"), "slides", 1))
        picture.draw(sliding, "Wireframe", BLUE, LineWidth=5.0, RenderLinesAsTubes=1)
        picture.legend.append("Blue frames: sliding joints.")


def ties(picture: Picture) -> None:
    """Ties by their force, on the structure as built."""
    picture.around(0.5)
    lines = picture.rods(picture.read("ties"), 0.004)
    picture.colour(picture.draw(lines), "CELLS", "tie_forces", "force of ties")


def thrust(picture: Picture) -> None:
    """Resultants where they act, thrust lines by eccentricity."""
    picture.around(0.5)
    source = picture.read("thrust")
    arrows = picture.arrows(source, "resultant_forces", 0.15, at_tip=False)
    drawn = [arrows]
    if picture.case["thrust_lines"]:
        drawn.append(picture.rods(picture.cells_with(source, "kind", 1)))
    for each in drawn:
        picture.colour(picture.draw(each), "POINTS", "eccentricity", "eccentricity: 1 at the edge")
    picture.legend = ["Arrows: resultant of each joint at its point of application, on its second body."]


def utilisation(picture: Picture) -> None:
    """Shear and torsion over what each joint carries of both."""
    picture.around()
    looks: dict[str, Any] = {"Surface": {"Opacity": 0.8}, "Wireframe": {"LineWidth": 4.0}}
    for kind, look in looks.items():
        shown = picture.draw(picture.read("interfaces"), kind, **look)
        picture.colour(shown, "CELLS", "torsion_use", "shear and torsion over what the joint carries")
    picture.legend = ["Joints by shear and torsion over what friction and cohesion carry of both; grey: no force."]


def loads(picture: Picture) -> None:
    """Dead load, live load and reactions as arrows, each kind to its own scale."""
    picture.draw(picture.read("blocks"), "Surface With Edges", Opacity=0.35)
    picture.around(0.0)
    source = picture.read("loads")
    drawn = []
    for name, words, colour in (
        ("dead_forces", "grey: dead load", GREY),
        ("live_forces", "orange: live load", ORANGE),
        ("reaction_forces", "green: reactions", GREEN),
    ):
        if source.PointData[name].GetRange(-1)[1] > 0:
            picture.draw(picture.arrows(source, name, 0.12, at_tip=name != "dead_forces"), "Surface", colour)
            drawn.append(words)
    picture.legend = [f"Arrows, each kind to its own scale; {', '.join(drawn)}."]


def animation(picture: Picture, file: str = "animation") -> None:
    """The mechanism with finite rotations."""
    source = picture.keep(simple.PVDReader(FileName=str(picture.folder / picture.case["files"][file])))
    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.GoToLast()
    picture.by_part(source)
    picture.around(0.0)


VIEWS: dict[str, tuple[str, Callable[[Picture], None]]] = {
    "structure": ("blocks", structure),
    "mechanism": ("animation", mechanism),
    "thrust": ("thrust", thrust),
    "utilisation": ("thrust", utilisation),
    "loads": ("loads", loads),
    "ties": ("ties", ties),
    "animation": ("animation", animation),
    "pushed": ("pushed", lambda picture: animation(picture, "pushed")),
    "history": ("history", lambda picture: animation(picture, "history")),
}
"""views by name: the file without which there is none, and who draws it"""


def _set(target: Any, **properties: Any) -> None:
    """Set properties, but for those that this version of ParaView does not have."""
    for name, value in properties.items():
        if hasattr(target, name):
            setattr(target, name, value)


def views_of(case: str) -> list[str]:
    """Views that a load case has."""
    return [name for name, (kind, _) in VIEWS.items() if kind in RESULT["cases"][case]["files"]]


def build(case: str, name: str, folder: Path) -> Picture:
    """One view, ready to be looked at."""
    picture = Picture(case, name, folder)
    VIEWS[name][1](picture)
    picture.finish()
    return picture


def save(picture: Picture, case: str, name: str, folder: Path) -> None:
    """As PNG; an animation as one PNG per frame."""
    write = simple.SaveAnimation if name in ("animation", "pushed", "history") else simple.SaveScreenshot
    write(str(folder / f"{RESULT['stem']}_{case}_{name}.png"), picture.view, ImageResolution=SIZE)


def read_arguments(words: list[str]) -> argparse.Namespace:
    """What to show; in ParaView itself there are no arguments."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--case", choices=list(RESULT["cases"]), help="load case; the first, or with --save all")
    parser.add_argument("--view", choices=list(VIEWS), help="one view; all of them if none is named")
    parser.add_argument("--save", metavar="DIR", type=Path, help="write PNG files there instead of opening a window")
    return parser.parse_args(words)


def here() -> Path:
    """Folder of this script."""
    return Path(__file__).resolve().parent if "__file__" in globals() else Path.cwd()


def main(words: list[str]) -> None:
    """Build the views, and save them or show them; raises SystemExit for a missing file or view."""
    arguments = read_arguments(words)
    cases = [arguments.case] if arguments.case else list(RESULT["cases"])
    missing = [
        file for case in cases for file in RESULT["cases"][case]["files"].values() if not (here() / file).exists()
    ]
    if missing:
        raise SystemExit(f"{here()}: {missing[0]} is not there; the script shows the files of its own folder")
    if arguments.save is not None:
        arguments.save.mkdir(parents=True, exist_ok=True)
    for case in cases if arguments.save is not None else cases[:1]:
        for name in [arguments.view] if arguments.view else views_of(case):
            if name not in views_of(case):
                raise SystemExit(f"load case {case} has no view {name}; it has {', '.join(views_of(case))}")
            picture = build(case, name, here())
            if arguments.save is not None:
                save(picture, case, name, arguments.save)
                picture.close()
            elif not paraview.fromGUI:
                simple.Interact(picture.view)
                picture.close()


if __name__ in ("__main__", "__vtkconsole__"):
    main([] if paraview.fromGUI else sys.argv[1:])
