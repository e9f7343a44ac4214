"""Many evaluations by one process."""

import gc
import math
import os
import signal
import threading

import pytest

from crushzone import CrushzoneError, InputError, Interrupted, Problem

FORCE = "parts.end.coupler.tube.stages[0].force_kN"
PEAK = "interfaces.peak_force_kN"


def is_gone(pid):
    """Neither running nor a zombie."""
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return True
    return False


def test_evaluations_have_the_values_of_a_run(tube):
    run = tube.run(set={FORCE: 812.5})
    with tube.evaluator() as evaluator:
        by_path = evaluator.evaluate(set={FORCE: 812.5}, want=[PEAK, "checks"])
        by_name = evaluator.evaluate(variables={"force": 812.5}, want=[PEAK, "checks"])
    assert by_path.values[PEAK] == run.interfaces[0]["peak_force_kN"]
    assert by_path.smallest_margin == run.smallest_margin
    assert by_path.checks.rows == by_name.checks.rows == run.checks.rows
    assert by_path.verdict == "fail" and not by_path.passes


def test_a_description_names_variables_and_limits(tube):
    description = tube.describe()
    force, stroke = description.variables
    assert (force.name, force.unit, force.min, force.max, force.start) == ("force", "kN", 450, 1500, 700)
    assert stroke.paths == ("parts.end.coupler.tube.stages[0].stroke_mm",)
    assert description.objective == "design.installed_length_mm" and description.objective_unit == "mm"
    assert "interface force, collision" in description.constraints
    assert description.metrics[PEAK] == "kN" and description.scenarios == ("collision",)


def test_many_designs_are_those_one_by_one(tube):
    designs = [[500 + 3 * i, 300 + i] for i in range(20)]
    with tube.evaluator() as evaluator:
        together = evaluator.evaluate_many(designs, want=[PEAK, "constraints"])
        apart = [evaluator.evaluate(variables=design, want=[PEAK, "constraints"]) for design in designs]
        by_path = evaluator.evaluate_many([{FORCE: 512}, {FORCE: 600}], by_path=True)
    assert together == apart
    assert len(together[0].constraints) == len(tube.describe().constraints)
    assert by_path[0] != by_path[1]


def test_lists_longer_than_a_line_are_answered(tube):
    short = Problem(tube.path, set={"simulation.duration_ms": 1})
    with short.evaluator() as evaluator:
        assert len(evaluator.evaluate_many([{}] * 1500)) == 1500
        assert evaluator.evaluate_many([]) == []


def test_a_gradient_has_a_derivative_by_each_variable(tube):
    with tube.evaluator() as evaluator:
        at = evaluator.gradient([700, 300], step=0.001, want=["constraints"])
        beside = evaluator.evaluate(variables=[700, 300.5])
    assert set(at.gradient) == {"objective", *evaluator.description.constraints}
    slope = (beside.objective - at.objective) / 0.5
    # the length is a sum of which the stroke is a term
    assert at.gradient["objective"]["stroke"] == pytest.approx(slope, rel=1e-9)
    assert at.gradient["objective"]["force"] == 0


def test_numbers_of_numpy_are_values(tube):
    numpy = pytest.importorskip("numpy")
    with tube.evaluator() as evaluator:
        x = numpy.array([700.25, 300.5])
        assert evaluator.evaluate(variables=x) == evaluator.evaluate(variables=[700.25, 300.5])
        assert evaluator.evaluate(set={FORCE: x[0]}) == evaluator.evaluate(set={FORCE: 700.25})
        assert evaluator.evaluate(variables=numpy.array([700, 300])).status == "ok"


def test_errors_of_requests_leave_the_evaluator_open(tube):
    with tube.evaluator() as evaluator:
        for wrong, message, help in (
            ({"variables": {"fource": 1}}, "no design variable 'fource'", "did you mean 'force'?"),
            ({"variables": [1, 1]}, "'force' is 1; it must be a number from 450 to 1500 kN", None),
            ({"set": {"trains.A.sped_km_h": 1}}, "unknown key 'sped_km_h'", "did you mean 'speed_km_h'?"),
            ({"want": ["interfaces.peak_forces_kN"]}, "no metric", None),
            ({"scenarios": ["crash"]}, "no scenario 'crash'", None),
        ):
            with pytest.raises(InputError, match=message) as caught:
                evaluator.evaluate(**wrong)
            assert help is None or caught.value.help == help
        with pytest.raises(ValueError, match="1 values for 2 variables"):
            evaluator.evaluate(variables=[700])
        with pytest.raises(ValueError):
            evaluator.evaluate(variables=[math.nan, 300])
        with pytest.raises(TypeError):
            evaluator.evaluate(want="checks")
        assert evaluator.evaluate().status == "ok"


def test_a_failed_run_is_a_result(tube):
    with tube.evaluator() as evaluator:
        failed = evaluator.evaluate(set={"simulation.longest_s": 0.01}, want=[PEAK])
    assert failed.status == "failed" and failed.failure.startswith("collision: ")
    assert math.isnan(failed.objective) and math.isinf(failed.violation) and math.isnan(failed.values[PEAK])


def test_the_process_ends_with_its_block(tube):
    with tube.evaluator() as evaluator:
        pid = evaluator._process.pid
        assert evaluator.is_open
    assert not evaluator.is_open and is_gone(pid)
    evaluator.close()
    with pytest.raises(CrushzoneError, match="closed"):
        evaluator.evaluate()


def test_the_process_ends_with_its_object(tube):
    evaluator = tube.evaluator()
    pid = evaluator._process.pid
    del evaluator
    gc.collect()
    assert is_gone(pid)


def test_a_file_with_mistakes_leaves_no_process(tube, tmp_path):
    bad = tmp_path / "bad.yaml"
    bad.write_text("schema: 1\ntrainz: []\n")
    with pytest.raises(InputError) as caught:
        Problem(bad).evaluator()
    assert caught.value.file == str(bad) and caught.value.line is not None
    gc.collect()
    with pytest.raises(ChildProcessError):
        os.waitpid(-1, os.WNOHANG)


def test_a_process_that_is_killed_raises(tube):
    with tube.evaluator() as evaluator:
        evaluator._process.send_signal(signal.SIGTERM)
        evaluator._process.wait()
        with pytest.raises(Interrupted):
            evaluator.evaluate()
        assert not evaluator.is_open


def test_threads_may_share_an_evaluator(tube):
    found = {}
    with tube.evaluator() as evaluator:
        def work(force):
            for _ in range(5):
                found.setdefault(force, []).append(evaluator.evaluate(set={FORCE: force}).objective)

        threads = [threading.Thread(target=work, args=(600 + 10 * i,)) for i in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    assert all(len(set(values)) == 1 for values in found.values()) and len(found) == 4


def test_answers_do_not_depend_on_threads_of_the_program(tube):
    designs = [[500 + i, 300] for i in range(30)]
    with tube.evaluator(jobs=1) as one, tube.evaluator(jobs=3) as three:
        assert one.evaluate_many(designs) == three.evaluate_many(designs)
