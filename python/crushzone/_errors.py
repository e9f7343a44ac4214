"""Exceptions, with the place of a mistake and a hint where the program gives them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Mistake:
    """A mistake or a warning: what is wrong, where, and what to do."""

    message: str
    file: str | None = None
    line: int | None = None  #: from 1
    column: int | None = None  #: from 1
    help: str | None = None

    @classmethod
    def from_json(cls, entry: Mapping[str, Any]) -> Mistake:
        """The mistake of an `error` in a JSON document."""
        return cls(
            message=entry.get("message") or "unknown error",
            file=entry.get("file"),
            line=entry.get("line"),
            column=entry.get("column"),
            help=entry.get("help"),
        )

    def __str__(self) -> str:
        place = [str(part) for part in (self.file, self.line, self.column) if part is not None]
        text = ":".join(place) + ": " if place else ""
        return text + self.message + (f" (help: {self.help})" if self.help else "")


class CrushzoneError(Exception):
    """A failure of a command or a request.

    `mistakes` has all that the program reports, the first one also as `message`, `file`, `line`,
    `column` and `help`.
    """

    def __init__(self, mistakes: Sequence[Mistake] | Mistake | str) -> None:
        if isinstance(mistakes, str):
            mistakes = Mistake(mistakes)
        self.mistakes: list[Mistake] = (
            [mistakes] if isinstance(mistakes, Mistake) else list(mistakes)
        )
        super().__init__("\n".join(str(mistake) for mistake in self.mistakes))

    @property
    def message(self) -> str:
        """The first mistake in one sentence."""
        return self.mistakes[0].message

    @property
    def file(self) -> str | None:
        """File of the first mistake; `--set` for a value that was set."""
        return self.mistakes[0].file

    @property
    def line(self) -> int | None:
        """Line of the first mistake, from 1; of a value that was set, its number."""
        return self.mistakes[0].line

    @property
    def column(self) -> int | None:
        """Column of the first mistake, from 1."""
        return self.mistakes[0].column

    @property
    def help(self) -> str | None:
        """Hint for the correction of the first mistake."""
        return self.mistakes[0].help

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.mistakes,)


class InputError(CrushzoneError):
    """A mistake in the problem file, in a value that was set, or in a request (exit code 2)."""


class RunFailed(CrushzoneError):
    """A run failed, or a command was not completed (exit code 3)."""


class OutputError(CrushzoneError):
    """A result cannot be written (exit code 4)."""


class Interrupted(CrushzoneError):
    """A signal ended the program (exit codes 130 and 143)."""


class ProgramNotFound(CrushzoneError):
    """The program crushzone is neither given, nor in CRUSHZONE, nor in PATH."""


def error_of(exit_code: int, mistakes: Sequence[Mistake] | Mistake | str) -> CrushzoneError:
    """The exception of an exit code of the program; a negative one is a signal."""
    kinds = {2: InputError, 3: RunFailed, 4: OutputError, 130: Interrupted, 143: Interrupted}
    kind = Interrupted if exit_code in (-2, -15) else kinds.get(exit_code, CrushzoneError)
    return kind(mistakes)
