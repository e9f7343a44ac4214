"""Many evaluations of one problem by one process: the client of `crushzone serve`."""

from __future__ import annotations

import itertools
import json
import math
import subprocess
import tempfile
import threading
import weakref
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import IO, Any

from ._errors import CrushzoneError, InputError, Mistake, error_of
from ._program import Value, plain
from ._results import Table

_MAX_AT_ONCE = 1024  # designs in one line
_PATIENCE_S = 5.0  # for the end of a process


@dataclass(frozen=True)
class Variable:
    """A design variable of `optimise:` in the file. Values are in `unit`."""

    name: str  #: its path, unless the file gives a name
    unit: str
    min: float
    max: float
    start: float
    increment: float  #: 0 without one
    fixed: bool  #: its bounds contain one value only
    choices: tuple[str, ...] = ()  #: names of the parts to choose from; its value is one of them
    paths: tuple[str, ...] = ()  #: places in the file that it sets


@dataclass(frozen=True)
class Description:
    """What a problem can be asked for."""

    title: str
    hash: str  #: of the content of the problem
    variables: tuple[Variable, ...]
    objective: str  #: name of what a search minimises
    objective_unit: str
    constraints: tuple[str, ...]  #: check and scenario, in the order of Evaluation.constraints
    scenarios: tuple[str, ...]
    metrics: Mapping[str, str]  #: names with their units


def _describe(answer: Mapping[str, Any]) -> Description:
    return Description(
        title=answer["problem"]["title"],
        hash=answer["problem"]["hash"],
        variables=tuple(
            Variable(
                name=entry["name"],
                unit=entry["unit"],
                min=entry["min"],
                max=entry["max"],
                start=entry["start"],
                increment=entry["increment"],
                fixed=entry["fixed"],
                choices=tuple(entry.get("choices", ())),
                paths=tuple(place["path"] for place in entry["places"]),
            )
            for entry in answer["variables"]
        ),
        objective=answer["minimises"]["name"],
        objective_unit=answer["minimises"]["unit"],
        constraints=tuple(answer["constraint_names"]),
        scenarios=tuple(entry["name"] for entry in answer["scenarios"]),
        metrics={entry["name"]: entry["unit"] for entry in answer["metrics"]},
    )


def _number(value: float | None) -> float:
    return math.nan if value is None else value


@dataclass(frozen=True)
class Evaluation:
    """Results of one design. Numbers that are not known are NaN."""

    status: str  #: ok, or failed when a run failed or did not end
    verdict: str  #: pass, fail or not checked
    objective: float  #: what a search minimises, in its unit
    violation: float  #: of the worst constraint; 0 when all are satisfied, infinite when failed
    smallest_margin: float  #: of all checks
    values: dict[str, float]  #: the metrics that were wanted, in their units
    failure: str | None = None  #: the first scenario that failed, and why
    constraints: list[float] = field(default_factory=list)  #: at most 0 when satisfied
    checks: Table | None = None  #: None unless wanted
    #: derivatives of "objective", of metrics and of constraints by the variables, per unit
    gradient: dict[str, dict[str, float]] = field(default_factory=dict)

    @property
    def passes(self) -> bool:
        """Whether all checks pass."""
        return self.verdict == "pass"


def _evaluation(answer: Mapping[str, Any]) -> Evaluation:
    return Evaluation(
        status=answer["status"],
        verdict=answer["verdict"],
        objective=_number(answer.get("objective")),
        violation=answer.get("violation", math.inf),
        smallest_margin=_number(answer.get("smallest_margin")),
        values={name: _number(value) for name, value in answer["values"].items()},
        failure=answer.get("failure"),
        constraints=[_number(value) for value in answer.get("constraints", ())],
        checks=Table.of_records(answer["checks"]) if "checks" in answer else None,
        gradient={
            slope["of"]: {name: _number(value) for name, value in slope["by"].items()}
            for slope in answer.get("gradient", ())
        },
    )


def _end(process: subprocess.Popen[bytes], standard_error: IO[bytes]) -> None:
    """Ends a process and waits for it, so that no zombie is left."""
    for stream in (process.stdin, process.stdout):
        try:
            if stream is not None:
                stream.close()
        except OSError:
            pass  # the process has left
    for stop in (None, process.terminate, process.kill):
        if stop is not None:
            stop()
        try:
            process.wait(_PATIENCE_S)
            break
        except subprocess.TimeoutExpired:
            pass
    standard_error.close()


class Evaluator:
    """A process `crushzone serve`: reads the problem once, then evaluates design after design.

    Use it in a `with` block, or call close(). It may be shared by threads; requests are answered
    one after the other.
    """

    def __init__(self, program: str, arguments: Sequence[str]) -> None:
        self._lock = threading.Lock()
        self._error_file = tempfile.TemporaryFile()
        self._process = subprocess.Popen(
            [program, *arguments],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self._error_file,
        )
        self._finalizer = weakref.finalize(self, _end, self._process, self._error_file)
        self._ids = itertools.count(1)
        try:
            self.description = _describe(self._ask({"op": "describe"}))
        except BaseException:
            self.close()
            raise

    def __enter__(self) -> Evaluator:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Ends the process; may be called twice."""
        self._finalizer()

    @property
    def is_open(self) -> bool:
        """Whether requests can be sent."""
        return self._finalizer.alive

    # ---- lines ----

    def _ended(self) -> CrushzoneError:
        """The exception for a process that has ended."""
        code = self._process.wait()
        self._error_file.seek(0)
        text = self._error_file.read().decode("utf-8", "replace").strip()
        self.close()
        return error_of(code, text or f"the program ended with the exit code {code}")

    def _exchange(self, request: Any) -> Any:
        line = json.dumps(request, allow_nan=False, separators=(",", ":")).encode("ascii") + b"\n"
        with self._lock:
            if not self.is_open:
                raise CrushzoneError("the evaluator is closed")
            assert self._process.stdin is not None and self._process.stdout is not None
            try:
                self._process.stdin.write(line)
                self._process.stdin.flush()
                answer = self._process.stdout.readline()
            except BrokenPipeError:
                answer = self._process.stdout.readline()
            except BaseException:  # as KeyboardInterrupt: the next answer would be of this request
                self.close()
                raise
            if not answer.endswith(b"\n"):
                raise self._ended()
        return json.loads(answer)

    def _checked(self, answer: Any, request: Mapping[str, Any]) -> Any:
        if answer["status"] == "error":
            raise InputError(Mistake.from_json(answer["error"]))
        if answer.get("id") != request.get("id"):
            self.close()
            raise CrushzoneError("an answer belongs to another request")
        return answer

    def _ask(self, request: dict[str, Any]) -> Any:
        request["id"] = next(self._ids)
        return self._checked(self._exchange(request), request)

    # ---- requests ----

    def _values(self, variables: Mapping[str, Any] | Sequence[Any]) -> dict[str, Value]:
        """Values by name, of a mapping or of all variables in the order of the description."""
        if isinstance(variables, Mapping):
            return {name: plain(value) for name, value in variables.items()}
        names = [variable.name for variable in self.description.variables]
        if len(variables) != len(names):
            raise ValueError(f"{len(variables)} values for {len(names)} variables")
        return {name: plain(value) for name, value in zip(names, variables)}

    def _request(
        self,
        set: Mapping[str, Any] | None,
        variables: Mapping[str, Any] | Sequence[Any] | None,
        scenarios: Sequence[str] | None,
        want: Sequence[str],
        **more: Any,
    ) -> dict[str, Any]:
        if isinstance(want, str) or isinstance(scenarios, str):
            raise TypeError("want and scenarios are lists of texts")
        request: dict[str, Any] = {key: value for key, value in more.items() if value is not None}
        if set:
            request["set"] = {path: plain(value) for path, value in set.items()}
        if variables is not None:
            request["variables"] = self._values(variables)
        if scenarios:
            request["scenarios"] = list(scenarios)
        if want:
            request["want"] = list(want)
        return request

    def evaluate(
        self,
        set: Mapping[str, Any] | None = None,
        *,
        variables: Mapping[str, Any] | Sequence[Any] | None = None,
        scenarios: Sequence[str] | None = None,
        want: Sequence[str] = (),
    ) -> Evaluation:
        """Runs and judges one design.

        `set` are values by path, as Problem.run(set=...). `variables` are values of design
        variables, by name or all in the order of the description, as a search sets them.
        `scenarios` are the only ones to run. `want` are further results: "checks", "constraints",
        and metrics such as "interfaces.A1-B1.peak_force_kN".
        """
        return _evaluation(self._ask(self._request(set, variables, scenarios, want)))

    def evaluate_many(
        self,
        designs: Sequence[Mapping[str, Any] | Sequence[Any]],
        *,
        scenarios: Sequence[str] | None = None,
        want: Sequence[str] = (),
        by_path: bool = False,
    ) -> list[Evaluation]:
        """Evaluates designs side by side, which is several times faster than one by one.

        A design is values of variables, as in evaluate(), or with `by_path` values by path. An
        error in one of them is raised for all.
        """
        evaluations: list[Evaluation] = []
        for first in range(0, len(designs), _MAX_AT_ONCE):
            requests = []
            for design in designs[first : first + _MAX_AT_ONCE]:
                given = (design, None) if by_path else (None, design)
                request = self._request(given[0], given[1], scenarios, want)  # type: ignore[arg-type]
                requests.append({**request, "id": next(self._ids)})
            answers = self._exchange(requests)
            evaluations += [
                _evaluation(self._checked(answer, request))
                for answer, request in zip(answers, requests)
            ]
        return evaluations

    def gradient(
        self,
        variables: Mapping[str, Any] | Sequence[Any] | None = None,
        *,
        set: Mapping[str, Any] | None = None,
        scenarios: Sequence[str] | None = None,
        want: Sequence[str] = (),
        step: float | None = None,
    ) -> Evaluation:
        """As evaluate(), with derivatives by differences in `gradient`, of the objective, of wanted
        metrics, and with "constraints" in `want` of those. `step` is a share of the range of each
        variable, 0.001 by default."""
        request = self._request(set, variables, scenarios, want, op="gradient", step=step)
        return _evaluation(self._ask(request))
