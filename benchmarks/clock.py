"""How long a job takes, for the benchmarks beside this file."""

import time


def best(job, *, runs=5):
    """Return the shortest time of some runs in milliseconds."""
    took = []
    for _ in range(runs):
        start = time.perf_counter()
        job()
        took.append(time.perf_counter() - start)
    return 1000 * min(took)
