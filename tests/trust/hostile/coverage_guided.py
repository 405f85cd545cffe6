"""A fuzzer that keeps what reaches new lines of the program (atheris, which is libFuzzer for Python).

::

    python -m tests.trust.hostile.coverage_guided FOLDER [RUNS] [SEED]

It begins with the decks of the program and with those that it refuses; the first byte of an input says of which kind
the file is, the rest is its content. What reached new lines is kept in ``FOLDER/corpus``, where the next call goes on.
A file that is answered by anything but a clear refusal or a model goes to ``FOLDER/finds``, and its story to
``FOLDER/result.json``, which says how many files were given: a call that finds one there gives those that are left,
with another seed. What kills the process itself, or takes more memory than
libFuzzer allows, is left in the current folder as ``crash-...``, ``oom-...`` or ``timeout-...``.
"""

from __future__ import annotations

import hashlib
import sys
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

import atheris

with atheris.instrument_imports(include=["mbla"]):
    from tests.trust.hostile import subject

from tests.trust.hostile.finds import Finds
from tests.trust.hostile.mutations import changed
from tests.trust.hostile.samples import seeds

RUNS = 100_000
MOST_MEGABYTES = 2000
"""of the whole process with what the fuzzer keeps; libFuzzer ends it beyond"""


def packed(kind: str, content: bytes) -> bytes:
    """A file as an input of the fuzzer."""
    return bytes([subject.KINDS.index(kind)]) + content


def unpacked(data: bytes) -> tuple[str, bytes]:
    """Kind and content of an input of the fuzzer."""
    return subject.KINDS[data[0] % len(subject.KINDS)] if data else "deck", data[1:]


def mutate(data: bytes, most: int, seed: int) -> bytes:
    """An input changed: by libFuzzer itself, or as the tree or text that it is."""
    rng = Random(seed)
    if rng.random() < 0.3:
        return bytes(atheris.Mutate(data, most))
    kind, content = unpacked(data)
    for _ in range(rng.choice((1, 1, 2, 4))):
        content = changed(kind, content, rng.choice)
    return packed(kind, content)[:most]


def main() -> None:
    """Fuzz; libFuzzer ends the process."""
    place = Path(sys.argv[1])
    runs = int(sys.argv[2]) if len(sys.argv) > 2 else RUNS
    seed = int(sys.argv[3]) if len(sys.argv) > 3 else 1
    corpus = place / "corpus"
    corpus.mkdir(parents=True, exist_ok=True)
    for kind, content in seeds():
        data = packed(kind, content)
        (corpus / hashlib.sha256(data).hexdigest()[:20]).write_bytes(data)
    record = place / "result.json"
    finds = Finds.resumed(record, place / "finds")
    if finds.runs >= runs:
        return
    with TemporaryDirectory() as folder:
        subject.prepare_folder(Path(folder))

        def one(data: bytes) -> None:
            finds.give(*unpacked(data), Path(folder))
            if finds.runs % 100 == 0:  # libFuzzer ends the process without a word to Python
                finds.write(record)

        left = [f"-runs={runs - finds.runs}", f"-seed={seed + finds.runs}"]
        options = [*left, "-timeout=60", f"-rss_limit_mb={MOST_MEGABYTES}", "-max_len=6000"]
        atheris.Setup([sys.argv[0], *options, str(corpus)], one, custom_mutator=mutate)
        atheris.Fuzz()


if __name__ == "__main__":
    main()
