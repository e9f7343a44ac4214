"""Fixtures, and results as lines that ./test counts.

SOURCE is the project's root, PROGRAM the program; both come from the test script. The package is
that of the source tree unless CZ_INSTALLED is set.
"""

import os
import sys
from pathlib import Path

import pytest

SOURCE = Path(os.environ.get("SOURCE", Path(__file__).parents[2]))
PROGRAM = os.environ.get("PROGRAM", str(SOURCE / "build/release/crushzone"))
sys.path.insert(0, str(SOURCE / "python"))
sys.path.insert(0, str(SOURCE / "examples/python"))
os.environ["CRUSHZONE"] = PROGRAM

SHORT = {"simulation.duration_ms": 20}


def pytest_runtest_logreport(report):
    """One line per case, with the sentence of its name."""
    name = report.nodeid.split("::")[-1].removeprefix("test_").replace("_", " ")
    if report.skipped:
        print(f"\nskipped - {name} ({report.longrepr[2].removeprefix('Skipped: ')})")
    elif report.failed:
        print(f"\nnot ok - {name}")
    elif report.when == "call":
        print(f"\nok - {name}")


@pytest.fixture
def tube():
    """A small problem with two design variables, `force` and `stroke`."""
    from crushzone import Problem

    return Problem(SOURCE / "examples/python/tube.yaml")


@pytest.fixture
def trains(tmp_path):
    """The file of `crushzone new two-trains`."""
    import subprocess

    file = tmp_path / "two-trains.yaml"
    subprocess.run([PROGRAM, "new", "two-trains", "-q", "-o", file], check=True)
    return file
