"""Mutants: the program with one thing made wrong, and whether a test next to it notices.

``python -m tests.trust.mutation [GROUP ...]`` makes a sample of mutants of the modules in :mod:`.groups` and runs the
tests next to them; what survives is printed with file, line and change.

The driver is our own. Tools start pytest for each mutant (mutmut, cosmic-ray, mutatest), and many fixtures here solve
structures, which takes longer than the tests. Here pytest runs once: the fixtures of a test are made by the right
program, then the test body runs in a forked process for each mutant of the lines it reaches, with the mutated code in
place of the right one. So mutants that only a fixture or a command in a process of its own would notice count as
survivors: the score is on the low side. A test that does not pass twice with the right program kills nothing.
"""
