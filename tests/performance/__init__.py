"""Recorded benchmarks, run by hand: ``python -m tests.performance.bench_stages`` and its like."""
