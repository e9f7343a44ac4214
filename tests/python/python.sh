# The Python package: its tests by pytest, and its wheel in a fresh virtual environment.
. "$SOURCE/tests/support/cases.sh"
export PYTHONDONTWRITEBYTECODE=1
for python in /usr/bin/python3 python3; do # Debian's first: that one has Debian's packages
    "$python" -c 'import sys, pytest; sys.exit(sys.version_info < (3, 11))' 2>/dev/null && break
    python=
done
if [ -z "$python" ]; then
    skipped "the Python package" "there is no python3 from 3.11 on with pytest"
    finish
fi
"$python" -m pytest -p no:cacheprovider -q --tb=short --durations=5 "$SOURCE/tests/python" 2>&1 | tee pytest.txt
# Its cases are in the lines above; a failure before the first case is one too.
n_passed=$(grep -c '^ok - ' pytest.txt)
n_failed=$(grep -c '^not ok - ' pytest.txt)
[ $((n_passed + n_failed)) -gt 0 ] || check "pytest runs" false

if ! "$python" -c 'import setuptools, wheel, pip, venv' 2>/dev/null; then
    skipped "the wheel in a fresh virtual environment" "setuptools, wheel, pip or venv is missing"
    finish
fi
wheel() { # built from a copy, because setuptools writes beside its sources
    rm -rf python dist && cp -r "$SOURCE/python" python && chmod -R u+w python && "$python" -m pip wheel -q --no-index --no-build-isolation --no-deps -w dist ./python && [ -f dist/crushzone-*-py3-none-any.whl ]
}
check "a wheel is built without network" wheel
installed() {
    rm -rf venv && "$python" -m venv --without-pip venv && "$python" -m pip --python venv/bin/python install -q --no-index dist/crushzone-*.whl
}
check "the wheel installs into a fresh virtual environment" installed
cat >use.py <<'END'
import sys
import crushzone
problem = crushzone.Problem(sys.argv[1])
assert crushzone.__file__.startswith(sys.prefix), crushzone.__file__
run = problem.run()
assert len(run.channels()) > 100 and run.checks[0]["margin"] > 0
try:
    run.checks.to_dataframe()
except ImportError as error:
    assert "python3-pandas" in str(error), error
else:
    raise AssertionError("pandas is in a fresh environment")
with problem.evaluator() as evaluator:
    assert evaluator.evaluate().status == "ok"
END
used() { CRUSHZONE=$PROGRAM venv/bin/python use.py "$SOURCE/examples/python/tube.yaml"; }
check "the standard library is enough to use it" used
finish
