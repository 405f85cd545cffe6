import subprocess
import sys

from mbla import __version__
from mbla.results.provenance import LIBRARIES, collect_provenance


def test_every_library_has_a_version() -> None:
    provenance = collect_provenance()
    assert provenance["mbla"] == __version__
    assert all(provenance[library][0].isdigit() for library in LIBRARIES)
    assert provenance["platform"]


def test_no_library_is_imported_for_it() -> None:
    code = (
        "import sys; from mbla.results.provenance import collect_provenance; collect_provenance(); "
        "print([name for name in ('h5py', 'meshio', 'clarabel') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
