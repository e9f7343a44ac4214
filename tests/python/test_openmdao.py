"""The component for OpenMDAO: over OpenMDAO itself where it is installed, else over a small stand-in of
its interface."""

import importlib.util
import sys

import pytest

from conftest import SOURCE

pytest.importorskip("numpy")
pytest.importorskip("scipy")


@pytest.fixture
def example(monkeypatch):
    """The example, with the stand-in where OpenMDAO is not installed."""
    monkeypatch.setenv("OPENMDAO_REPORTS", "0")
    if importlib.util.find_spec("openmdao") is None:
        monkeypatch.syspath_prepend(str(SOURCE / "tests/python/stand_in"))
    monkeypatch.syspath_prepend(str(SOURCE / "examples/openmdao"))
    import component

    yield component
    for name in ("component", "openmdao", "openmdao.api"):
        sys.modules.pop(name, None)


@pytest.fixture
def collision(example, tube):
    """The component in a problem of OpenMDAO, which is set up."""
    import openmdao.api as om

    problem = om.Problem()
    made = example.TrainCollision(file=tube.path, metrics=["interfaces.peak_force_kN"])
    problem.model.add_subsystem("collision", made, promotes=["*"])
    problem.setup()
    yield problem
    made.evaluator.close()


def test_outputs_are_those_of_the_evaluator(collision, tube):
    collision.set_val("force", 750)
    collision.run_model()
    with tube.evaluator() as evaluator:
        design = {"force": 750.0, "stroke": evaluator.description.variables[1].start}
        wanted = evaluator.evaluate(variables=design, want=["constraints", "interfaces.peak_force_kN"])
    assert collision.get_val("objective").item() == wanted.objective
    assert list(collision.get_val("constraints")) == wanted.constraints
    assert collision.get_val("interfaces_peak_force_kN").item() == wanted.values["interfaces.peak_force_kN"]


def test_partials_agree_with_differences_of_the_outputs(collision):
    step = 0.5  # kN and mm; the steps of the component are about 1 kN and 0.5 mm
    totals = collision.compute_totals(of=["objective", "constraints"], wrt=["force", "stroke"])
    slopes = {key: value.copy() for key, value in totals.items()}
    for name in ("force", "stroke"):
        start = collision.get_val(name).item()
        values = []
        for at in (start - step, start + step):
            collision.set_val(name, at)
            collision.run_model()
            values.append([collision.get_val(of).copy() for of in ("objective", "constraints")])
        collision.set_val(name, start)
        for k, of in enumerate(("objective", "constraints")):
            difference = (values[1][k] - values[0][k]) / (2 * step)
            assert slopes[of, name][:, 0] == pytest.approx(difference, rel=1e-2, abs=1e-9)


def test_a_failed_run_is_an_analysis_error(example, tube):
    import openmdao.api as om

    problem = om.Problem()
    slow = tube.path.parent / "tube.yaml"
    made = example.TrainCollision(file=slow)
    problem.model.add_subsystem("collision", made, promotes=["*"])
    problem.setup()
    made.evaluator.evaluate = lambda **_: type("Failed", (), {"status": "failed", "failure": "late"})()
    with pytest.raises(om.AnalysisError, match="late"):
        problem.run_model()
    made.evaluator.close()


def test_names_are_valid_ones(example):
    assert example.valid_name("parts.end.tube.stages[0].force_kN") == "parts_end_tube_stages_0_force_kN"


def test_slsqp_over_the_component_finds_the_hand_check(example, tube, capsys):
    example.main(str(tube.path))
    lines = [line.split() for line in capsys.readouterr().out.splitlines()]
    printed = dict(words for words in lines if len(words) == 2)  # drivers print lines of their own
    # energy of the buffer and of the rise of the tube are estimated (the file's hand check)
    assert float(printed["stroke"]) == pytest.approx(210, rel=0.03)
    assert float(printed["interfaces_peak_force_kN"]) == pytest.approx(800, rel=1e-3)
