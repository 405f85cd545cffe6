"""Files whose bytes are not those that were written: damage of disks and copies."""

from __future__ import annotations

import random
from collections.abc import Callable

PAGE = 4096


def _flipped(image: bytes, generator: random.Random) -> bytes:
    spoilt = bytearray(image)
    for _ in range(generator.choice([1, 1, 1, 2, 8, 64])):
        spoilt[generator.randrange(len(image))] ^= 1 << generator.randrange(8)
    return bytes(spoilt)


def _cut_off(image: bytes, generator: random.Random) -> bytes:
    return image[: generator.randrange(len(image))]


def _zeroed(image: bytes, generator: random.Random) -> bytes:
    page = generator.randrange(len(image) // PAGE) * PAGE
    return _over(image, page, bytes(min(PAGE, len(image) - page)))


def _overwritten(image: bytes, generator: random.Random) -> bytes:
    length = generator.choice([1, 8, 64, 512, PAGE])
    return _over(image, generator.randrange(len(image) - length), generator.randbytes(length))


def _moved(image: bytes, generator: random.Random) -> bytes:
    """A page in the place of another."""
    source, target = (generator.randrange(len(image) // PAGE) * PAGE for _ in range(2))
    return _over(image, target, image[source : source + PAGE][: len(image) - target])


def _longer(image: bytes, generator: random.Random) -> bytes:
    place, more = generator.randrange(len(image) + 1), generator.randbytes(generator.choice([1, 8, 512]))
    return image[:place] + more + image[place:]


def _shorter(image: bytes, generator: random.Random) -> bytes:
    place, length = generator.randrange(len(image) - 512), generator.choice([1, 8, 512])
    return image[:place] + image[place + length :]


def _over(image: bytes, place: int, stretch: bytes) -> bytes:
    return image[:place] + stretch + image[place + len(stretch) :]


DAMAGES: dict[str, Callable[[bytes, random.Random], bytes]] = {
    "bits flipped": _flipped,
    "cut off": _cut_off,
    "page zeroed": _zeroed,
    "stretch overwritten": _overwritten,
    "page moved": _moved,
    "bytes inserted": _longer,
    "bytes left out": _shorter,
}


def damaged(image: bytes, kind: str, generator: random.Random) -> bytes:
    """The file with damage of a kind; never as it was."""
    while (spoilt := DAMAGES[kind](image, generator)) == image:
        pass
    return spoilt
