# Design loops of other programs: the examples for Dakota and make as they are, with what those programs do.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/cli/cli.sh"
PATH=$BUILD:$PATH
export PATH

# ---- Dakota: the test writes its files as its manual describes them ----

PROBLEM=$SOURCE/problems/length-or-force.yaml
export PROBLEM
components=$(sed -n "s/^ *\(analysis_components = \)*'\([^']*=[^']*\)'$/\2/p" "$SOURCE/examples/dakota/dakota.in")
parameters() { # parameters FORCE STROKE ASV: the two variables and responses of the example
    cat <<END
                                          2 variables
                      $1 force
                      $2 stroke
                                          2 functions
                                          $3 ASV_1:length
                                          $3 ASV_2:reserve
                                          2 derivative_variables
                                          1 DVV_1:force
                                          2 DVV_2:stroke
                                          4 analysis_components
$(echo "$components" | awk '{ printf "%40s AC_%d:driver.sh\n", $0, NR }')
                                          1 eval_id
END
}
driver() { sh "$SOURCE/examples/dakota/driver.sh" params.in results.out; }

four_meanings() { [ "$(echo "$components" | wc -l)" = 4 ]; }
check "the input file of Dakota gives four descriptors a meaning" four_meanings
values() { # two values with their labels, as run computes them
    parameters 800 350 1 >params.in && exits 0 driver && [ "$(wc -l <results.out)" = 2 ] &&
        exits 0 "$C" run "$PROBLEM" --json -q --set 'parts.end.coupler.tube.stages[0].force_kN=800' --set 'parts.end.coupler.tube.stages[0].stroke_mm=350' &&
        says out.txt "\"margin\": $(sed -n 's/ reserve$//p' results.out),"
}
check "the driver answers with the values of run" values
newton() { # steps by value and gradient find the stroke that is used to 90 %
    stroke=230
    for step in 1 2 3 4 5; do
        parameters 800 $stroke 3 >params.in && exits 0 driver || return 1
        stroke=$(awk -v s=$stroke '/ reserve$/ { margin = $1 } /^\[/ { slope = $3 } END { printf "%.15e", s - margin / slope }' results.out)
    done
    awk '/ reserve$/ { exit !($1 < 1e-4 && $1 > -1e-4) }' results.out
}
check "values and gradients of the files lead to the limit" newton
in_a_folder() { # as Dakota does: in a work directory, with that and the folder where Dakota was started before PATH
    named() { sed -n "s/^ *$1 *= *'\([^']*\)'$/\1/p" "$SOURCE/examples/dakota/dakota.in"; }
    mkdir -p work.1 && parameters 800 350 1 >work.1/"$(named parameters_file)" && ! grep -q copy_files "$SOURCE/examples/dakota/dakota.in" &&
        (cd work.1 && unset PROBLEM && PATH=.:$SOURCE/examples/dakota:$PATH && exits 0 "$(named analysis_drivers)" "$(named parameters_file)" "$(named results_file)") && [ "$(wc -l <work.1/results.out)" = 2 ]
}
check "the driver runs in a work directory as dakota.in names it" in_a_folder
active() { parameters 800 350 2 >params.in && exits 0 driver && [ "$(cut -c1-2 results.out | tr '\n' /)" = '[ /[ /' ]; }
check "only what the active set asks for is written" active
hessian() { parameters 800 350 7 >params.in && exits 0 driver && says results.out 'second derivatives' && [ "$(head -1 results.out)" = fail ]; }
check "a Hessian is a failed evaluation" hessian
run_fails() { # a run that does not end is a failed evaluation, and not a failed driver
    parameters 800 350 1 >params.in && exits 0 "$C" dakota params.in results.out --problem "$PROBLEM" --set simulation.longest_s=0.02 && [ "$(head -1 results.out)" = fail ] && says results.out longest_s
}
check "a run that fails is a failed evaluation" run_fails
mistake() { # the study is set up wrongly: the driver fails, and so does the evaluation
    parameters 800 350 1 | sed 's/ASV_1:length/ASV_1:interfaces.peek/' >params.in && sed -i 's/length=.*AC_3/force=trains.A.speed_km_h AC_3/' params.in && exits 2 driver && says err.txt 'params.in:5:43: error: there is no metric' && [ "$(head -1 results.out)" = fail ]
}
check "an unknown descriptor fails with its line" mistake
bad_problem() { echo 'schema: 1' >bad.yaml && exits 2 "$C" dakota params.in results.out --problem bad.yaml && [ "$(head -1 results.out)" = fail ]; }
check "a problem with mistakes fails" bad_problem
no_problem() { exits 2 "$C" dakota params.in results.out && says err.txt '--problem FILE'; }
check "the problem is required" no_problem
whole() { # the results are put in place at once: nothing else is left beside them, and a folder that is not there is an error
    parameters 800 350 1 >params.in && mkdir -p one && exits 0 "$C" dakota params.in one/results.out --problem "$PROBLEM" && [ "$(ls -A one)" = results.out ] &&
        exits 4 "$C" dakota params.in none/results.out --problem "$PROBLEM"
}
check "results are written whole or not at all" whole
play() { sh "$SOURCE/examples/dakota/play.sh" 5 >table.txt && [ "$(wc -l <table.txt)" = 6 ] && awk 'NR == 2 { first = $5 } NR == 6 { exit !($5 > first) }' table.txt; }
check "a parameter study of the example runs" play

# ---- make ----

cp -r "$SOURCE/examples/make" study
made_again() { # made_again FILE: what make runs after a change of a file, in one line
    touch -d "${2:-now + 2 seconds}" "study/$1" && make -C study -n | sed -n 's/^crushzone run .*-o \([^ ]*\).*/\1/p' | tr '\n' ' '
}
if command -v make >/dev/null; then
    first() { make -C study >make.txt 2>&1 && says study/compared.txt 'out/stiff' && [ -f study/out/soft/summary.json ] && [ -z "$(make -C study -n | grep crushzone)" ]; }
    check "make runs every design once" first
    one() { [ "$(made_again curves/soft.csv)" = 'out/soft ' ]; }
    check "a changed curve runs again only its design" one
    both() { settle_times && [ "$(made_again base.yaml 'now + 6 seconds')" = 'out/soft out/stiff ' ]; }
    settle_times() { make -C study >make.txt 2>&1 && touch -d 'now + 4 seconds' study/out/soft/summary.json study/out/stiff/summary.json && touch -d 'now + 5 seconds' study/compared.txt; }
    check "a changed base file runs all designs again" both
    removed() { rm study/curves/soft.csv && ! make -C study >make.txt 2>&1 && says make.txt soft.csv && says make.txt 'there is no file'; }
    check "a removed curve is reported by crushzone and not by make" removed
else
    skipped "the example for make" "make is not installed"
fi
odd_names() { # a path with a blank, # and $ is written as make reads it
    mkdir -p 'a b' && cp "$PROBLEM" 'a b/x#$y.yaml' && exits 0 "$C" check 'a b/x#$y.yaml' -o out/ --depfile odd.d -q && [ "$(head -2 odd.d)" = 'out/summary.json: \
  a\ b/x\#$$y.yaml' ]
}
check "paths are written as make reads them" odd_names
search() { exits 0 "$C" optimise "$PROBLEM" --evaluations 4 -o found -q --depfile found.d; says found.d 'found/outcome.json:'; }
check "optimise writes the dependencies of its outcome" search
refused() {
    exits 2 "$C" check "$PROBLEM" --depfile no.d && says err.txt 'needs a result folder' && cp "$PROBLEM" p.yaml && exits 2 "$C" run p.yaml 'a b/x#$y.yaml' -o several --depfile no.d && says err.txt 'one problem file' && [ ! -e no.d ] &&
        exits 4 "$C" run p.yaml -o again --depfile p.yaml && says err.txt 'would be replaced'
}
check "dependencies need one problem and one folder, and replace no file that is read" refused
finish
