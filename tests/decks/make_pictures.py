"""The pictures in decks/pictures, made by ``mbla run`` and ``mbla plot``; those of the README's sweep and its diagram.

``python -m tests.decks.make_pictures`` makes them all (some decks take minutes), with names those alone:
``python -m tests.decks.make_pictures wall_push_x``.
"""

from __future__ import annotations

import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from mbla.cli import main
from mbla.results.hdf5.result_file import read_results_hdf5
from mbla.results.series import series_of
from tests.decks.folder import DECKS

PICTURES = DECKS / "pictures"
README = "README.md"
"""in place of a deck: the one that the README prints"""


SMALLER = ("--size", "1200x750")
"""for pictures in space, whose files are large"""


@dataclass(frozen=True)
class DeckPicture:
    """One file of decks/pictures.

    name : of the file, without its suffix
    deck : below decks/, or ``README``
    case : load case; of a travelling load its name in the deck, the worst position is drawn
    plot : options of ``mbla plot``
    """

    name: str
    deck: str
    case: str
    plot: tuple[str, ...] = ()


TABLE = (
    DeckPicture("wall_push_x", README, "push_x"),
    DeckPicture("wall_push_x_forces", README, "push_x", ("--kind", "forces")),
    DeckPicture("wall_model", README, "push_x", ("--kind", "model")),
    DeckPicture("oppenheim_arch_push_x", "benchmarks/published/oppenheim_arch.yaml", "push_x"),
    DeckPicture(
        "oppenheim_arch_push_x_forces", "benchmarks/published/oppenheim_arch.yaml", "push_x", ("--kind", "forces")
    ),
    DeckPicture("settling_wall_sinks", "tutorials/settling_wall.yaml", "sinks"),
    DeckPicture("obj_wall_out_of_plane", "tutorials/obj_wall.yaml", "out_of_plane", SMALLER),
    DeckPicture("crossvault_along_x", "tutorials/crossvault.yaml", "along_x", SMALLER),
    DeckPicture("house_push_x", "structures/house.yaml", "push_x", SMALLER),
    DeckPicture("house_push_y", "structures/house.yaml", "push_y", SMALLER),
    DeckPicture("room_push_y", "structures/room.yaml", "push_y", SMALLER),
    DeckPicture("colonnade_across", "structures/colonnade.yaml", "across", SMALLER),
    DeckPicture("arch_bridge", "structures/arch_bridge.yaml", "axle", SMALLER),
    DeckPicture("cross_vault_on_piers_spreading", "structures/cross_vault_on_piers.yaml", "spreading", SMALLER),
    DeckPicture("dome_on_drum_push_x", "structures/dome_on_drum.yaml", "push_x", SMALLER),
    DeckPicture("spiral_stair_one_tread", "structures/spiral_stair.yaml", "one_tread", SMALLER),
    DeckPicture("retaining_wall_surcharge", "structures/retaining_wall.yaml", "surcharge", SMALLER),
)


STUDIES = ("door_sweep", "wall_interact")
"""pictures of studies of the README's deck, in decks/sweeps/README.md"""
SAMPLE = ("points: 8,", "points: 200,")
"""the sweep of that page is small, so that it runs at once; its picture is of more points"""


def deck_path(picture: DeckPicture, folder: Path) -> Path:
    """The deck of a picture; that of the README is written to the folder."""
    if picture.deck != README:
        return DECKS / picture.deck
    path = folder / "wall.yaml"
    path.write_text(readme_block("`wall.yaml`:"), encoding="utf-8")
    return path


def readme_block(start: str, page: Path = DECKS.parent / README) -> str:
    """The first code block of a page after a piece of text."""
    text = page.read_text(encoding="utf-8")
    return text.split(start, 1)[1].split("```", 2)[1].split("\n", 1)[1]


def make_picture(picture: DeckPicture, folder: Path) -> Path:
    """Solve the deck, once for all of its pictures in that folder, and draw one; the path written."""
    deck = deck_path(picture, folder)
    out = folder / f"{deck.stem}.out"
    result = out / f"{deck.stem}.h5"
    if not result.exists():
        status = main(["run", str(deck), "-o", str(out), "--set", "output.vtu=false", "-q"])
        assert status in (0, 4, 5), f"{deck}: mbla run ended with {status}"
    case = picture.case
    for series in series_of(read_results_hdf5(result).cases):
        if series.name == case and series.worst is not None:
            case = series.worst.load_case.name
    target = PICTURES / f"{picture.name}.png"
    assert main(["plot", str(result), "--case", case, "-o", str(target), *picture.plot]) == 0
    return target


def make_study(name: str, folder: Path) -> Path:
    """Solve a study of the README's deck and draw it; the path written."""
    target = PICTURES / f"{name}.png"
    deck = deck_path(TABLE[0], folder)
    if name == "wall_interact":
        assert main(["interact", str(deck), "--directions", "72", "-o", str(folder / "interact"), "-q"]) == 0
        return (folder / "interact" / f"{name}.png").replace(target)
    sweep, out = folder / "door.yaml", folder / "door.out"
    text = readme_block("`door.yaml`, beside", DECKS / "sweeps" / README)
    assert text.count(SAMPLE[0]) == 1
    sweep.write_text(text.replace(*SAMPLE), encoding="utf-8")
    assert main(["sweep", str(sweep), "-q"]) == 0
    assert main(["sweep-plot", str(out), "--kind", "distribution", "-o", str(target), *SMALLER]) == 0
    return target


def make_pictures(names: list[str]) -> None:
    """The pictures of those names, all without any."""
    known = [*(picture.name for picture in TABLE), *STUDIES]
    unknown = sorted(set(names) - set(known))
    if unknown:
        raise SystemExit(f"no picture {', '.join(unknown)}; there are {', '.join(known)}")
    with tempfile.TemporaryDirectory() as folder:
        for picture in TABLE:
            if not names or picture.name in names:
                make_picture(picture, Path(folder))
        for name in STUDIES:
            if not names or name in names:
                make_study(name, Path(folder))


if __name__ == "__main__":
    make_pictures(sys.argv[1:])
