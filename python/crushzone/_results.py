"""Results: tables, runs, optima, samples."""

from __future__ import annotations

import csv
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Union

from ._errors import CrushzoneError, Mistake

if TYPE_CHECKING:
    from ._problem import Problem
    from ._program import Value

#: A value in a table: None where it is unknown or does not apply.
Cell = Union[float, int, str, bool, None]


class Table(Sequence["dict[str, Cell]"]):
    """Rows with the same keys; keys of numbers end in their unit, such as `force_kN`."""

    def __init__(self, columns: Sequence[str], rows: Sequence[Sequence[Cell]]) -> None:
        self.columns: list[str] = list(columns)
        self.rows: list[list[Cell]] = [list(row) for row in rows]

    @classmethod
    def of_records(cls, records: Sequence[dict[str, Any]]) -> Table:
        """A table of records; lists and records in them are left out, keys that only some records
        have are None in the others."""
        columns: dict[str, None] = {}
        for record in records:
            for key, value in record.items():
                if not isinstance(value, (dict, list)):
                    columns[key] = None
        return cls(list(columns), [[record.get(key) for key in columns] for record in records])

    @classmethod
    def of_csv(cls, file: Path) -> Table:
        """A table of a CSV file of a result folder with commas and decimal points."""
        with open(file, newline="", encoding="utf-8") as stream:
            lines = csv.reader(stream)
            columns = next(lines)
            return cls(columns, [[_cell(text) for text in line] for line in lines])

    def __len__(self) -> int:
        return len(self.rows)

    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, str):
            return self.column(index)
        if isinstance(index, slice):
            return Table(self.columns, self.rows[index])
        return dict(zip(self.columns, self.rows[index]))

    def __iter__(self) -> Iterator[dict[str, Cell]]:
        return (dict(zip(self.columns, row)) for row in self.rows)

    def __repr__(self) -> str:
        return f"Table({len(self)} rows: {', '.join(self.columns)})"

    def column(self, name: str) -> list[Cell]:
        """The values of one column."""
        if name not in self.columns:
            raise KeyError(f"no column '{name}'; there are: {', '.join(self.columns)}")
        at = self.columns.index(name)
        return [row[at] for row in self.rows]

    def to_numpy(self, *names: str) -> Any:
        """The columns as an array of floats (rows x columns), unknown values as NaN."""
        import numpy

        return numpy.array(
            [[float("nan") if cell is None else cell for cell in self.column(name)] for name in names],
            dtype=float,
        ).T

    def to_dataframe(self) -> Any:
        """The table as a pandas.DataFrame."""
        try:
            import pandas
        except ImportError as error:
            raise ImportError(
                "to_dataframe needs pandas: apt install python3-pandas, or pip install pandas"
            ) from error
        return pandas.DataFrame(self.rows, columns=self.columns)

    def plot(self, x: str, *y: str, axes: Any = None) -> Any:
        """Draws columns over column x with matplotlib; returns the axes."""
        if axes is None:
            from matplotlib import pyplot

            axes = pyplot.figure().add_subplot()
        for name in y:
            axes.plot(self.column(x), self.column(name), label=name)
        axes.set_xlabel(x)
        axes.legend()
        return axes


def _cell(text: str) -> Cell:
    if text == "":
        return None
    try:
        return float(text)
    except ValueError:
        return text


class _Folder:
    """A result folder: the caller's, or a temporary one that lasts as long as the results."""

    def __init__(self, output: str | Path | None) -> None:
        self._temporary = None
        if output is None:
            self._temporary = tempfile.TemporaryDirectory(prefix="crushzone-")
            output = Path(self._temporary.name) / "out"
        self.path = Path(output)


class _Document:
    """A JSON document of the program with its folder, if it has one."""

    def __init__(self, document: dict[str, Any], folder: _Folder | None = None) -> None:
        self.document: dict[str, Any] = document  #: the JSON document, see docs/results.md
        self._folder = folder

    @property
    def folder(self) -> Path | None:
        """The result folder; it is removed with this object unless `output` named it."""
        return self._folder.path if self._folder is not None else None

    def _csv(self, *names: str) -> Table:
        if self.folder is None:
            raise CrushzoneError(Mistake("these results have no folder", help="use run()"))
        for name in names:
            if (self.folder / name).exists():
                return Table.of_csv(self.folder / name)
        raise CrushzoneError(f"there is no {names[0]} in {self.folder}")

    @property
    def verdict(self) -> str:
        """pass, fail or not checked, over all checks."""
        return str(self.document["verdict"])

    @property
    def passes(self) -> bool:
        """Whether all checks pass, provisional passes among them."""
        return self.verdict == "pass"

    @property
    def warnings(self) -> list[Mistake]:
        """Warnings of the problem file and of the runs."""
        return [Mistake.from_json(entry) for entry in self.document.get("warnings", [])]


class Run(_Document):
    """The runs of all scenarios of one design: summary.json and the histories."""

    @property
    def status(self) -> str:
        """completed, or failed when a scenario failed or is incomplete."""
        return str(self.document["status"])

    @property
    def checks(self) -> Table:
        """Checks of all scenarios: name, scenario, where, limit, value, unit, margin, verdict."""
        return Table.of_records(self.document["checks"])

    @property
    def smallest_margin(self) -> float | None:
        """Smallest margin of all checks; None when none has a margin."""
        margins = [check["margin"] for check in self.document["checks"]]
        return min((margin for margin in margins if margin is not None), default=None)

    @property
    def scenarios(self) -> list[str]:
        """Names of the scenarios that were run."""
        return [scenario["name"] for scenario in self.document["scenarios"]]

    def _of_scenarios(self, key: str) -> Table:
        return Table.of_records(
            [
                {"scenario": scenario["name"], **record}
                for scenario in self.document["scenarios"]
                for record in scenario[key]
            ]
        )

    @property
    def interfaces(self) -> Table:
        """Interfaces of all scenarios: peak_force_kN, shortening_mm, energy_kJ and others."""
        return self._of_scenarios("interfaces")

    @property
    def vehicles(self) -> Table:
        """Vehicles of all scenarios: decelerations [g], wheel lifts [mm] and others."""
        return self._of_scenarios("vehicles")

    @property
    def events(self) -> Table:
        """Events of all scenarios with their times [ms]."""
        return self._of_scenarios("events")

    def channels(self, scenario: str | None = None) -> Table:
        """Histories of a scenario, of the only one by default: t_ms, forces F_..._kN, strokes
        d_..._mm, speeds v_..._m_s and others (docs/channels.md)."""
        if scenario is None and len(self.scenarios) > 1:
            raise CrushzoneError(
                Mistake("which scenario?", help="one of: " + ", ".join(self.scenarios))
            )
        return self._csv(f"{scenario or self.scenarios[0]}/channels.csv", "channels.csv")


class Optimum(_Document):
    """The outcome of a search: outcome.json and its folder."""

    def __init__(self, document: dict[str, Any], folder: _Folder, problem: Problem) -> None:
        super().__init__(document, folder)
        self._problem = problem

    @property
    def status(self) -> str:
        """feasible, infeasible or interrupted."""
        return str(self.document["status"])

    @property
    def objective(self) -> float:
        """The objective of the best design, in its unit."""
        return float(self.document["objective"]["value"])

    @property
    def values(self) -> dict[str, Value]:
        """Values of the variables of the best design by name, in their units: the `variables` of
        an evaluator; a choice by its name."""
        return {
            variable["name"]: variable.get("choice", variable["value"])
            for variable in self.document["variables"]
        }

    @property
    def variables(self) -> Table:
        """Variables with bounds, start and best value."""
        return Table.of_records(self.document["variables"])

    @property
    def constraints(self) -> Table:
        """Limits of the search with their margins, before and after."""
        return Table.of_records(self.document["constraints"])

    @property
    def history(self) -> Table:
        """Every evaluated design."""
        return self._csv("history.csv")

    @property
    def problem(self) -> Problem:
        """The problem of the best design, from the folder."""
        assert self.folder is not None
        return self._problem.beside(self.folder / "optimised.yaml")


class Sampling(_Document):
    """Samples of the uncertain numbers of a problem: sample.json and samples.csv."""

    @property
    def checks(self) -> Table:
        """Checks with the share of samples that pass and quantiles of their margins."""
        return Table.of_records(self.document["checks"])

    @property
    def samples(self) -> Table:
        """Drawn values and margins of every sample."""
        return self._csv("samples.csv")
