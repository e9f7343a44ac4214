"""Starts the program crushzone: finding it, its arguments, its JSON documents."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Union

from ._errors import Mistake, ProgramNotFound, error_of

#: A value of a path: a number in the unit of the path's key, a text, or a yes or no.
Value = Union[float, int, str, bool]


def find_program(program: str | os.PathLike[str] | None = None) -> str:
    """The path of the program: as given, else that in the environment variable CRUSHZONE, else in
    PATH."""
    wanted = os.fspath(program or os.environ.get("CRUSHZONE") or "crushzone")
    found = shutil.which(wanted)
    if found is None:
        raise ProgramNotFound(
            Mistake(
                f"the program '{wanted}' is not there",
                help="install crushzone, or name the program: Problem(..., program=...), or the "
                "environment variable CRUSHZONE",
            )
        )
    return found


def plain(value: Any) -> Value:
    """A value as JSON has it; numbers of numpy become those of Python."""
    if isinstance(value, (bool, str)):
        return value
    if type(value).__name__ in ("bool_", "bool"):  # of numpy
        return bool(value)
    return int(value) if isinstance(value, int) else float(value)


def text_of(value: Any) -> str:
    """A value as text that reads back to the same bits."""
    value = plain(value)
    if isinstance(value, bool):
        return "true" if value else "false"
    return value if isinstance(value, str) else repr(value)


def settings(values: Mapping[str, Any] | None) -> list[str]:
    """Options --set of values by path."""
    options = []
    for path, value in (values or {}).items():
        options += ["--set", f"{path}={text_of(value)}"]
    return options


def options_of(**given: Any) -> list[str]:
    """Options of the command line from those that are not None: n_job=2 is --n-job 2."""
    options = []
    for name, value in given.items():
        flag = "--" + name.rstrip("_").replace("_", "-")
        if value is True:
            options.append(flag)
        elif value is not None and value is not False:
            options += [flag, text_of(value) if not isinstance(value, Path) else os.fspath(value)]
    return options


def _document(text: str) -> Any:
    try:
        return json.loads(text)
    except ValueError:
        return None


def mistakes_of(document: Any, standard_error: str) -> list[Mistake]:
    """The mistakes of a document of errors, else what the program wrote to standard error."""
    if isinstance(document, dict) and document.get("errors"):
        return [Mistake.from_json(entry) for entry in document["errors"]]
    if isinstance(document, dict) and document.get("error"):
        return [Mistake.from_json(document["error"])]
    return [Mistake(standard_error.strip() or "the program ended without a message")]


def run_json(program: str, arguments: Sequence[str], document_name: str) -> dict[str, Any]:
    """Runs a command with --json and returns its document; raises the exception of its exit code
    when it has none of that name."""
    done = subprocess.run(
        [program, *arguments, "--json"],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        encoding="utf-8",
        errors="replace",
        check=False,
    )
    document = _document(done.stdout)
    if isinstance(document, dict) and document.get("format") == f"crushzone.{document_name}":
        return document
    raise error_of(done.returncode, mistakes_of(document, done.stderr))
