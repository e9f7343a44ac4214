"""Runs, searches and samples of a problem file."""

import json
import os
import pickle
import subprocess

import pytest

from conftest import PROGRAM, SHORT, SOURCE
from crushzone import CrushzoneError, InputError, OutputError, Problem, ProgramNotFound, Table

FORCE = "parts.end.coupler.tube.stages[0].force_kN"


def test_a_run_has_the_values_of_the_program(tube):
    run = tube.run(set={FORCE: 812.5})
    done = subprocess.run(
        [PROGRAM, "run", tube.path, "--set", f"{FORCE}=812.5", "--json", "-q"],
        capture_output=True,
        check=True,
    )
    expected = json.loads(done.stdout)
    assert run.document["checks"] == expected["checks"]
    assert run.verdict == expected["verdict"] == "fail"
    assert run.checks[1]["value"] == expected["checks"][1]["value"]
    assert run.smallest_margin == min(check["margin"] for check in expected["checks"])
    assert not run.passes and run.status == "completed" and run.scenarios == ["collision"]


def test_check_judges_without_a_folder(tube):
    checked = tube.check(set={FORCE: 900})
    assert checked.verdict == "fail" and checked.folder is None
    with pytest.raises(CrushzoneError, match="no folder"):
        checked.channels()


def test_settings_of_the_problem_hold_in_all_commands(tube):
    faster = Problem(tube.path, set={"trains.A.speed_km_h": 25})
    assert faster.check().smallest_margin < tube.check().smallest_margin
    assert faster.check(set={"trains.A.speed_km_h": 20}).document["checks"] == tube.check().document["checks"]


def test_histories_of_a_scenario_are_tables(tube):
    run = tube.run()
    channels = run.channels()
    assert channels.columns[0] == "t_ms" and len(channels) > 100
    assert max(channels["F_A1-B1_kN"]) <= run.interfaces[0]["peak_force_kN"]
    assert run.interfaces.column("name") == ["A1-B1"]
    assert len(run.vehicles) == 2 and "contact" in run.events.column("what")
    with pytest.raises(KeyError, match="no column 'F_kN'"):
        channels.column("F_kN")


def test_several_scenarios_are_named(trains):
    run = Problem(SOURCE / "problems/metro-6-car.yaml", set=SHORT).run()
    assert len(run.scenarios) > 1 and len(run.interfaces) == 11 * len(run.scenarios)
    with pytest.raises(CrushzoneError, match="which scenario"):
        run.channels()
    assert len(run.channels(run.scenarios[1])) > 10
    only = Problem(SOURCE / "problems/metro-6-car.yaml", set=SHORT).run(scenario=run.scenarios[1])
    assert only.channels().rows == run.channels(run.scenarios[1]).rows


def test_results_become_data_frames(tube):
    pandas = pytest.importorskip("pandas")
    run = tube.run()
    for table in (run.channels(), run.interfaces, run.checks):
        frame = table.to_dataframe()
        assert isinstance(frame, pandas.DataFrame)
        assert list(frame.columns) == table.columns and len(frame) == len(table)
    assert run.interfaces.to_dataframe().peak_force_kN[0] == run.interfaces[0]["peak_force_kN"]
    assert run.channels().to_dataframe()["t_ms"].is_monotonic_increasing


def test_columns_become_arrays(tube):
    numpy = pytest.importorskip("numpy")
    channels = tube.run().channels()
    array = channels.to_numpy("t_ms", "F_A1-B1_kN")
    assert array.shape == (len(channels), 2)
    assert numpy.trapz([1, 2], [0, 1]) == 1.5 and array[:, 1].max() == max(channels["F_A1-B1_kN"])


def test_columns_are_drawn(tube):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    axes = tube.run().channels().plot("d_A1-B1_mm", "F_A1-B1_kN")
    assert axes.get_xlabel() == "d_A1-B1_mm" and len(axes.lines) == 1


def test_tables_are_sequences():
    table = Table(["name", "mass_t"], [["A1", 40.0], ["A2", None], ["A3", 42.0]])
    assert [row["name"] for row in table] == ["A1", "A2", "A3"]
    assert table[-1] == {"name": "A3", "mass_t": 42.0} and len(table[1:]) == 2
    assert Table.of_records([{"a": 1, "b": [2]}, {"c": "x"}]).rows == [[1, None], [None, "x"]]


def test_a_folder_is_kept_or_removed(tube, tmp_path):
    kept = tube.run(output=tmp_path / "kept")
    assert (kept.folder / "report.html").exists()
    run = tube.run()
    folder = run.folder
    assert folder.exists()
    del run
    assert not folder.exists()


def test_a_mistake_has_file_line_column_and_help(tmp_path):
    text = (SOURCE / "examples/python/tube.yaml").read_text().replace("stroke_mm: 300, force_kN: 700", "stroke_mm: 300, forse_kN: 700")
    bad = tmp_path / "bad.yaml"
    bad.write_text(text)
    for command in ("validate", "run", "check", "optimise", "describe"):
        with pytest.raises(InputError) as caught:
            getattr(Problem(bad), command)()
        error = caught.value
        assert error.file == str(bad)
        assert text.splitlines()[error.line - 1][error.column - 1 :].startswith("forse_kN")
        assert error.help == "did you mean 'force_kN'?"
        assert f"{bad}:{error.line}:{error.column}: " in str(error)
    assert pickle.loads(pickle.dumps(error)).mistakes == error.mistakes


def test_all_mistakes_of_a_file_are_reported(tmp_path):
    bad = tmp_path / "bad.yaml"
    bad.write_text("schema: 1\ntitle: bad\ntrainz: []\npartz: {}\n")
    with pytest.raises(InputError) as caught:
        Problem(bad).validate()
    assert len(caught.value.mistakes) >= 2


def test_a_value_that_is_set_has_its_number(tube):
    with pytest.raises(InputError) as caught:
        tube.run(set={FORCE: 800, "trains.A.sped_km_h": 3})
    assert (caught.value.file, caught.value.line) == ("--set", 2)
    assert caught.value.help == "did you mean 'speed_km_h'?"


def test_an_absent_file_is_an_input_error(tmp_path):
    with pytest.raises(InputError, match="nowhere.yaml"):
        Problem(tmp_path / "nowhere.yaml").run()


def test_a_folder_that_cannot_be_written_is_an_output_error(tube, tmp_path):
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "file").write_text("not ours")
    with pytest.raises(OutputError):
        tube.run(output=tmp_path / "other")


def test_a_run_that_does_not_end_is_a_result(tube):
    assert tube.check(set={"simulation.longest_s": 0.01}).status == "failed"


def test_the_program_is_found_by_argument_environment_and_path(tube, tmp_path, monkeypatch):
    monkeypatch.delenv("CRUSHZONE")
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(ProgramNotFound, match="CRUSHZONE"):
        Problem(tube.path)
    assert Problem(tube.path, program=PROGRAM).check().status == "completed"
    os.symlink(PROGRAM, tmp_path / "crushzone")
    assert Problem(tube.path).program == str(tmp_path / "crushzone")
    monkeypatch.setenv("CRUSHZONE", str(tmp_path / "other"))
    with pytest.raises(ProgramNotFound):
        Problem(tube.path)


def test_samples_are_a_table(tube, tmp_path):
    scattered = tmp_path / "scattered.yaml"
    scattered.write_text(
        f"extends: {tube.path}\nuncertainty:\n  parameters: [{{path: trains.A.speed_km_h, tolerance_percent: 5}}]\n"
    )
    sampling = Problem(scattered).sample(samples=6, seed=3)
    assert len(sampling.samples) == 6 and sampling.verdict in ("pass", "fail", "not checked")
    assert "name" in sampling.checks.columns


def test_the_version_is_that_of_the_project():
    import re

    import crushzone

    wanted = re.search(r"project\(crushzone VERSION ([0-9.]+)", (SOURCE / "CMakeLists.txt").read_text())[1]
    assert crushzone.__version__ == wanted
    assert f'version = "{wanted}"' in (SOURCE / "python/pyproject.toml").read_text()
