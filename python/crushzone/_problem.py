"""Problem files and the commands of the program."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ._evaluator import Description, Evaluator
from ._program import find_program, options_of, run_json, settings
from ._results import Optimum, Run, Sampling, _Folder


class Problem:
    """A problem file of crushzone.

    `set` are values by path that replace those of the file in all commands, such as
    ``{"trains.A.speed_km_h": 30}``; paths end in their unit. `program` is the program, by default
    that of the environment variable CRUSHZONE, or crushzone in PATH.
    """

    def __init__(
        self,
        path: str | os.PathLike[str],
        *,
        set: Mapping[str, Any] | None = None,
        program: str | os.PathLike[str] | None = None,
    ) -> None:
        self.path = Path(path)
        self.set: dict[str, Any] = dict(set or {})
        self.program = find_program(program)

    def __repr__(self) -> str:
        return f"Problem({str(self.path)!r})"

    def beside(self, path: str | os.PathLike[str]) -> Problem:
        """Another file for the same program."""
        return Problem(path, program=self.program)

    def _arguments(self, command: str, set: Mapping[str, Any] | None, **options: Any) -> list[str]:
        file = os.fspath(self.path)
        return [
            command,
            os.path.join(".", file) if file.startswith("-") else file,
            *settings({**self.set, **(set or {})}),
            *options_of(**options),
        ]

    def _run(self, command: str, document: str, set: Any, **options: Any) -> dict[str, Any]:
        return run_json(self.program, self._arguments(command, set, **options), document)

    def validate(self) -> None:
        """Reads the file without a run; raises InputError with all its mistakes."""
        self._run("validate", "validation", None, quiet=True)

    def describe(self) -> Description:
        """Design variables, constraints, scenarios and metrics of the problem."""
        with self.evaluator() as evaluator:
            return evaluator.description

    def run(
        self,
        set: Mapping[str, Any] | None = None,
        *,
        scenario: str | None = None,
        output: str | os.PathLike[str] | None = None,
        jobs: int | None = None,
        replace: bool = False,
    ) -> Run:
        """Simulates and judges, with histories.

        `scenario` is the only scenario or family to run. `output` keeps the result folder with its
        report, which is otherwise removed with the results; `replace` allows it to replace the
        folder of a search.
        """
        folder = _Folder(Path(output) if output is not None else None)
        document = self._run(
            "run", "summary", set, scenario=scenario, output=folder.path, jobs=jobs, force=replace
        )
        return Run(document, folder)

    def check(
        self,
        set: Mapping[str, Any] | None = None,
        *,
        scenario: str | None = None,
        jobs: int | None = None,
    ) -> Run:
        """Simulates and judges without histories, which is faster than run()."""
        return Run(self._run("check", "summary", set, scenario=scenario, jobs=jobs))

    def optimise(
        self,
        set: Mapping[str, Any] | None = None,
        *,
        output: str | os.PathLike[str] | None = None,
        evaluations: int | None = None,
        algorithm: str | None = None,
        seed: int | None = None,
        max_time: str | None = None,
        jobs: int | None = None,
    ) -> Optimum:
        """Searches the design variables of the file; `max_time` such as "5min". An outcome that is
        infeasible or interrupted is returned like any other; see its `status`."""
        folder = _Folder(Path(output) if output is not None else None)
        document = self._run(
            "optimise",
            "outcome",
            set,
            output=folder.path,
            evaluations=evaluations,
            algorithm=algorithm,
            seed=seed,
            max_time=max_time,
            jobs=jobs,
        )
        return Optimum(document, folder, self)

    def sample(
        self,
        set: Mapping[str, Any] | None = None,
        *,
        samples: int | None = None,
        seed: int | None = None,
        output: str | os.PathLike[str] | None = None,
        jobs: int | None = None,
    ) -> Sampling:
        """Draws the uncertain numbers of the file's `uncertainty:` and judges every sample."""
        folder = _Folder(Path(output) if output is not None else None)
        document = self._run(
            "sample", "sample", set, samples=samples, seed=seed, output=folder.path, jobs=jobs
        )
        return Sampling(document, folder)

    def evaluator(
        self,
        set: Mapping[str, Any] | None = None,
        *,
        scenario: str | None = None,
        jobs: int | None = None,
    ) -> Evaluator:
        """A process that evaluates one design after the other; use it in a `with` block."""
        return Evaluator(
            self.program,
            self._arguments("serve", set, scenario=scenario, jobs=jobs, quiet=True),
        )
