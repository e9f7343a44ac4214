"""loop.py BENCH_LOOP FILE [N [ROUNDS]]: N evaluations over `crushzone serve` from Python, beside the same ones by the C
library in one process (bench_loop); both on one thread, in turn. Of each evaluation the smallest time of all rounds
counts, and of all evaluations the median, which other work disturbs least.

Processor time, start-up included, is that of both processes over serve.
The last line is "ratio R": the speed from Python as a share of that of the library. Exit code 1 when the results differ.
"""

import resource
import subprocess
import sys
import time
from pathlib import Path
from statistics import median

sys.path.insert(0, str(Path(__file__).parents[2] / "python"))

from crushzone import Problem


def design(variables, n):
    """The n-th design of bench_loop."""
    return [
        v.min + (v.max - v.min) * (0.25 + 0.5 * ((n * 7 + i * 3) % 100) / 100)
        for i, v in enumerate(variables)
    ]


def by_library(program, file, n):
    done = subprocess.run([program, file, str(n)], capture_output=True, text=True, check=True)
    return [tuple(map(float, line.split())) for line in done.stdout.splitlines()]


def by_serve(file, n):
    found = []
    with Problem(file).evaluator(jobs=1) as evaluator:
        variables = evaluator.description.variables
        for k in range(n):
            started = time.perf_counter()
            objective = evaluator.evaluate(variables=design(variables, k)).objective
            found.append((time.perf_counter() - started, objective))
    return found


def typical(rounds):
    """The median of the smallest times of each evaluation [ms]."""
    return 1e3 * median(min(seconds for seconds, _ in times) for times in zip(*rounds))


def processor_time():
    """Of this process and of its children that have ended [s]."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(one.ru_utime + one.ru_stime for one in used)


def main(program, file, n=1000, rounds=5):
    library, serve, used = [], [], []
    for _ in range(int(rounds)):
        begun = processor_time()
        library.append(by_library(program, file, int(n)))
        between = processor_time()
        serve.append(by_serve(file, int(n)))
        used.append((between - begun, processor_time() - between))
    ours, theirs = typical(library), typical(serve)
    print(f"{n} evaluations: {ours:.3f} ms each by the library, {theirs:.3f} ms over serve from Python")
    for_library, for_serve = (min(one) for one in zip(*used))
    print(f"processor time {for_library:.3f} s and {for_serve:.3f} s: {for_library / for_serve:.3f}")
    same = len({tuple(objective for _, objective in times) for times in library + serve}) == 1
    print("the same results" if same else "the results differ")
    print(f"ratio {ours / theirs:.3f}")
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
