"""A fuzzer that keeps what reaches new lines of the program (atheris, which is libFuzzer for Python).

::

    python -m tests.trust.hostile.coverage_guided FOLDER [RUNS] [SEED]

It begins with the decks of the program and with those that it refuses; the first byte of an input says of which kind
the file is, the rest is its content. What reached new lines is kept in ``FOLDER/corpus``, where the next call goes on.
The first file that is answered by anything but a clear refusal or a model ends it with an exit status other than 0, and
is left in ``FOLDER`` as ``crash-...``, ``oom-...`` or ``timeout-...``.
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
    runs, seed = [*map(int, sys.argv[2:]), *(RUNS, 1)[len(sys.argv) - 2 :]]
    corpus = place / "corpus"
    corpus.mkdir(parents=True, exist_ok=True)
    for kind, content in seeds():
        data = packed(kind, content)
        (corpus / hashlib.sha256(data).hexdigest()[:20]).write_bytes(data)
    with TemporaryDirectory() as folder:
        subject.prepare_folder(Path(folder))
        options = [f"-runs={runs}", f"-seed={seed}", "-timeout=60", f"-rss_limit_mb={MOST_MEGABYTES}", "-max_len=6000"]
        options.append(f"-artifact_prefix={place}/")
        atheris.Setup(
            [sys.argv[0], *options, str(corpus)],
            lambda data: subject.give(*unpacked(data), Path(folder)),
            custom_mutator=mutate,
        )
        atheris.Fuzz()


if __name__ == "__main__":
    main()
