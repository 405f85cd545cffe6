"""Certificates: what is called solved is proved by the result file alone.

- :mod:`tests.trust.certificates.cells`, :mod:`tests.trust.certificates.assemblies`: random assemblies as decks;
- :mod:`tests.trust.certificates.whole_line`: a deck through run, result file and verify;
- :mod:`tests.trust.certificates.claims`: what a run must keep of what it claims;
- :mod:`tests.trust.certificates.exact_bounds`: both bounds in rational arithmetic.
"""
