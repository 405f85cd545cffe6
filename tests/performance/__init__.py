"""Recorded benchmarks, run by hand: ``python -m tests.performance.bench_contacts`` and its like."""
