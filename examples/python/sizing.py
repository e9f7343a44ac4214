"""The same sizing twice: by `crushzone optimise`, and by SLSQP of SciPy over an evaluator.

    python3 examples/python/sizing.py examples/python/tube.yaml
"""

import sys

import numpy
from scipy import optimize

from crushzone import Evaluation, Evaluator, Problem


class Design:
    """Objective and constraints with their gradients, each design evaluated once."""

    def __init__(self, evaluator: Evaluator) -> None:
        self.evaluator = evaluator
        self.names = [variable.name for variable in evaluator.description.variables]
        self.constraints = evaluator.description.constraints
        self.x: tuple[float, ...] | None = None
        self.n = 0

    def at(self, x: numpy.ndarray) -> Evaluation:
        if self.x != tuple(x):
            self.x = tuple(x)
            self.last = self.evaluator.gradient(x, want=["constraints"])
            self.n += 1 + len(x)
        return self.last

    def objective(self, x: numpy.ndarray) -> tuple[float, numpy.ndarray]:
        last = self.at(x)
        return last.objective, self.slope(last, "objective")

    def reserves(self, x: numpy.ndarray) -> numpy.ndarray:
        return -numpy.array(self.at(x).constraints)  # SciPy wants them at least 0

    def slopes(self, x: numpy.ndarray) -> numpy.ndarray:
        last = self.at(x)
        return -numpy.array([self.slope(last, name) for name in self.constraints])

    def slope(self, last: Evaluation, of: str) -> numpy.ndarray:
        return numpy.array([last.gradient[of][name] for name in self.names])


def by_scipy(problem: Problem) -> tuple[dict[str, float], float, int]:
    """Values of the variables, objective, number of designs."""
    with problem.evaluator() as evaluator:
        design = Design(evaluator)
        variables = evaluator.description.variables
        found = optimize.minimize(
            design.objective,
            [variable.start for variable in variables],
            jac=True,
            method="SLSQP",
            bounds=[(variable.min, variable.max) for variable in variables],
            constraints={"type": "ineq", "fun": design.reserves, "jac": design.slopes},
        )
        assert found.success, found.message
        return dict(zip(design.names, found.x)), design.at(found.x).objective, design.n


def main(file: str) -> None:
    problem = Problem(file)
    ours = problem.optimise()
    values, objective, n = by_scipy(problem)
    for name, of, best, designs in (
        ("crushzone", ours.values, ours.objective, ours.document["evaluations"]),
        ("SLSQP", values, objective, n),
    ):
        print(
            f"{name:10} {best:8.2f} mm by {designs:3} designs:",
            ", ".join(f"{key} {value:.1f}" for key, value in of.items()),
        )


if __name__ == "__main__":
    main(sys.argv[1])
