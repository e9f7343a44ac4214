"""Every block of docs/loops.md about Python is run, in the order of the page."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from conftest import PROGRAM, SOURCE

PAGE = SOURCE / "docs/loops.md"


def blocks():
    """Kind and text of the page's blocks of Python and of their commands."""
    return re.findall(r"^```(bash|python)\n(.*?)^```$", PAGE.read_text(), re.M | re.S)


def run_shell(text, environment):
    """Runs commands after `$ `; each line below one must be in its output."""
    output = ""
    for line in text.splitlines():
        if line.startswith("$ "):
            command = line[2:].replace("/usr/bin/python3", sys.executable)
            done = subprocess.run(
                command, shell=True, capture_output=True, text=True, env=environment
            )
            assert done.returncode == 0, command + "\n" + done.stdout + done.stderr
            output = done.stdout
        else:
            assert line in output.splitlines(), f"not printed: {line}\n{output}"


def test_the_page_about_python_runs(tmp_path, monkeypatch):
    for module in ("pandas", "scipy", "setuptools", "wheel", "pip", "venv", "ensurepip"):
        pytest.importorskip(module)
    for folder in ("python", "examples", "problems"):
        shutil.copytree(SOURCE / folder, tmp_path / folder)
    monkeypatch.chdir(tmp_path)
    bin = tmp_path / "bin"
    bin.mkdir()
    os.symlink(PROGRAM, bin / "crushzone")
    environment = {key: value for key, value in os.environ.items() if key != "CRUSHZONE"}
    environment["PATH"] = f"{bin}:{environment['PATH']}"
    script = ""
    for kind, text in blocks():
        if kind == "python":
            script += text
        else:
            run_shell(text, environment)
    Path("page.py").write_text(script)
    assert script.count("\n") > 50
    done = subprocess.run(["venv/bin/python", "page.py"], capture_output=True, text=True, env=environment)
    assert done.returncode == 0, done.stdout + done.stderr
