"""crushzone from Python: runs, searches and design loops of problem files.

>>> from crushzone import Problem                                    # doctest: +SKIP
>>> problem = Problem("two-trains.yaml")
>>> run = problem.run(set={"trains.A.speed_km_h": 30})
>>> run.verdict, run.checks.to_dataframe()

The package starts the program ``crushzone`` and needs only the standard library.
pandas, numpy and matplotlib are used where they are installed.
Values have the unit of their path or key, such as ``force_kN``, and are equal to
those of the program to the last bit.
"""

from ._errors import (
    CrushzoneError,
    InputError,
    Interrupted,
    Mistake,
    OutputError,
    ProgramNotFound,
    RunFailed,
)
from ._evaluator import Description, Evaluation, Evaluator, Variable
from ._problem import Problem
from ._results import Optimum, Run, Sampling, Table

__version__ = "0.1.0"

__all__ = [
    "CrushzoneError",
    "Description",
    "Evaluation",
    "Evaluator",
    "InputError",
    "Interrupted",
    "Mistake",
    "Optimum",
    "OutputError",
    "Problem",
    "ProgramNotFound",
    "Run",
    "RunFailed",
    "Sampling",
    "Table",
    "Variable",
]
