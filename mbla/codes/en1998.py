"""EN 1998-1:2004: elastic spectra with the recommended values."""

from __future__ import annotations

from mbla.codes.coefficients import coefficients
from mbla.codes.spectrum import Spectrum


def spectrum(a_g: float, kind: int, soil: str) -> Spectrum:
    """EN 1998-1:2004, 3.2.2.2 with Tables 3.2 and 3.3, types 1 and 2; a_g [g].

    Raises KeyError for types and grounds that they do not have.
    """
    table = coefficients("en_1998")
    amplification, *corners = table[str(kind)][soil]
    return Spectrum(a_g, amplification, table["plateau"], *corners)
