"""What examples/openmdao uses of OpenMDAO's interface, for one component without connections.

Names, arguments and the order of calls are those of OpenMDAO 3: initialize() before options are set,
setup(), setup_partials(), then compute() before compute_partials() at the same inputs. Values are arrays,
and a partial derivative has a row for each element of the output and a column for each of the input.
"""

import numpy
from scipy import optimize


class AnalysisError(Exception):
    """A component that cannot be computed at these inputs."""


class _Options(dict):
    def declare(self, name, default=None, desc=""):
        assert name not in self, f"option {name} is declared twice"
        self[name] = default


class ExplicitComponent:
    def __init__(self, **options):
        self.options = _Options()
        self.inputs, self.outputs, self.partials = {}, {}, {}
        self.initialize()
        for name, value in options.items():
            assert name in self.options, f"option {name} is not declared"
            self.options[name] = value

    def initialize(self):
        pass

    def setup_partials(self):
        pass

    def _add(self, values, name, val=1.0, shape=None, units=None, desc=""):
        assert name.isidentifier(), f"'{name}' is no valid name"
        assert name not in self.inputs and name not in self.outputs, f"{name} is added twice"
        values[name] = numpy.full(shape if shape is not None else 1, val, dtype=float)

    def add_input(self, name, val=1.0, **more):
        self._add(self.inputs, name, val, **more)

    def add_output(self, name, val=1.0, **more):
        self._add(self.outputs, name, val, **more)

    def declare_partials(self, of, wrt):
        assert (of, wrt) == ("*", "*"), "the stand-in knows all partials only"
        for output, value in self.outputs.items():
            for name, by in self.inputs.items():
                self.partials[output, name] = numpy.zeros((value.size, by.size))


class _Values:
    """Arrays that are assigned in place, as OpenMDAO's vectors are."""

    def __init__(self, values, writable):
        self._values, self._writable = values, writable

    def __getitem__(self, key):
        return self._values[key].copy()

    def __setitem__(self, key, value):
        assert self._writable, "inputs are read only"
        array = self._values[key]
        array[...] = numpy.asarray(value, dtype=float).reshape(array.shape)


class _Model:
    def __init__(self):
        self.design_variables, self.constraints, self.objective = {}, {}, None

    def add_subsystem(self, name, component, promotes=()):
        assert list(promotes) == ["*"], "the stand-in promotes all names"
        self.component = component

    def add_design_var(self, name, lower=None, upper=None):
        self.design_variables[name] = (lower, upper)

    def add_objective(self, name):
        self.objective = name

    def add_constraint(self, name, upper=None):
        self.constraints[name] = upper


class ScipyOptimizeDriver:
    def __init__(self, optimizer="SLSQP", tol=1e-6):
        self.optimizer, self.tol = optimizer, tol


class Problem:
    def __init__(self):
        self.model = _Model()

    def setup(self):
        self.model.component.setup()
        self.model.component.setup_partials()

    def run_model(self):
        component = self.model.component
        component.compute(_Values(component.inputs, False), _Values(component.outputs, True))

    def compute_totals(self, of=None, wrt=None):
        component = self.model.component
        component.compute_partials(_Values(component.inputs, False), _Values(component.partials, True))
        return component.partials

    def set_val(self, name, value):
        self.model.component.inputs[name][...] = value

    def get_val(self, name):
        component = self.model.component
        return component.inputs.get(name, component.outputs.get(name))  # not a copy

    def run_driver(self):
        model, names = self.model, list(self.model.design_variables)

        def move(x):
            for name, value in zip(names, x):
                self.set_val(name, value)
            self.run_model()

        def value(x):
            move(x)
            return self.get_val(model.objective).item()

        def slope(x, of):
            move(x)
            return numpy.hstack([self.compute_totals()[of, name] for name in names])

        def reserve(x, of, upper):
            move(x)
            return upper - self.get_val(of)

        found = optimize.minimize(
            value,
            [self.get_val(name).item() for name in names],
            jac=lambda x: slope(x, model.objective)[0],
            method=self.driver.optimizer,
            tol=self.driver.tol,
            bounds=[model.design_variables[name] for name in names],
            constraints=[
                {
                    "type": "ineq",
                    "fun": lambda x, of=of, upper=upper: reserve(x, of, upper),
                    "jac": lambda x, of=of: -slope(x, of),
                }
                for of, upper in model.constraints.items()
            ],
        )
        move(found.x)
        return found
