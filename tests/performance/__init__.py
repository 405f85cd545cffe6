"""Recorded benchmarks, run by hand: ``python -m tests.performance.bench_line`` and its like."""
