"""A problem of crushzone as an explicit component of OpenMDAO, and a sizing with it.

    python3 examples/openmdao/component.py examples/python/tube.yaml

Inputs are the design variables of the problem, outputs its objective, its constraints (at most 0 when
they are satisfied) and the metrics that are named. Partial derivatives are differences of designs that
are computed side by side.
"""

import re
import sys

import numpy
import openmdao.api as om

from crushzone import Evaluation, Problem


def valid_name(text: str) -> str:
    """A name as OpenMDAO allows it: letters, digits and underscores."""
    return re.sub(r"\W+", "_", text).strip("_")


class TrainCollision(om.ExplicitComponent):
    """Evaluates designs of one problem by a process that reads it once."""

    def initialize(self) -> None:
        self.options.declare("file", desc="problem file with design variables")
        self.options.declare("metrics", default=(), desc="further outputs, by their names")

    def setup(self) -> None:
        self.evaluator = Problem(self.options["file"]).evaluator()
        description = self.evaluator.description
        # A variable that chooses a part, or has one value only, keeps that of the file.
        self.variables = {
            valid_name(variable.name): variable
            for variable in description.variables
            if not variable.fixed and not variable.choices
        }
        for name, variable in self.variables.items():
            self.add_input(name, val=variable.start, desc=f"{variable.name} in {variable.unit}")
        self.add_output("objective", desc=f"{description.objective} in {description.objective_unit}")
        self.add_output("constraints", shape=len(description.constraints))
        for metric in self.options["metrics"]:
            self.add_output(valid_name(metric), desc=metric)

    def setup_partials(self) -> None:
        self.declare_partials("*", "*")

    def compute(self, inputs, outputs) -> None:
        result = self._answered(
            self.evaluator.evaluate(variables=self._design(inputs), want=self._wanted())
        )
        outputs["objective"] = result.objective
        outputs["constraints"] = result.constraints
        for metric in self.options["metrics"]:
            outputs[valid_name(metric)] = result.values[metric]

    def compute_partials(self, inputs, partials) -> None:
        result = self._answered(self.evaluator.gradient(self._design(inputs), want=self._wanted()))
        constraints = self.evaluator.description.constraints
        for name, variable in self.variables.items():
            slopes = {of: by[variable.name] for of, by in result.gradient.items()}
            partials["objective", name] = slopes["objective"]
            partials["constraints", name] = [[slopes[of]] for of in constraints]
            for metric in self.options["metrics"]:
                partials[valid_name(metric), name] = slopes[metric]

    def _design(self, inputs) -> dict[str, float]:
        return {
            variable.name: float(numpy.asarray(inputs[name]).item())
            for name, variable in self.variables.items()
        }

    def _wanted(self) -> list[str]:
        return ["constraints", *self.options["metrics"]]

    def _answered(self, result: Evaluation) -> Evaluation:
        if result.status != "ok":  # drivers of OpenMDAO try another design
            raise om.AnalysisError(result.failure)
        return result


def main(file: str) -> None:
    problem = om.Problem()
    collision = TrainCollision(file=file, metrics=["interfaces.peak_force_kN"])
    problem.model.add_subsystem("collision", collision, promotes=["*"])
    problem.driver = om.ScipyOptimizeDriver(optimizer="SLSQP", tol=1e-6)
    for variable in Problem(file).describe().variables:
        problem.model.add_design_var(
            valid_name(variable.name), lower=variable.min, upper=variable.max
        )
    problem.model.add_objective("objective")
    problem.model.add_constraint("constraints", upper=0.0)
    problem.setup()
    problem.run_driver()
    for name in (*collision.variables, "objective", "interfaces_peak_force_kN"):
        print(name, f"{problem.get_val(name).item():.2f}")


if __name__ == "__main__":
    main(sys.argv[1])
