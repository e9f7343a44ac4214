# Reads the output of `ctest -V` and writes one line per test case: "passed|failed|skipped preset program: case".
#
# Cases are those of cmocka ("[       OK ] name") and of scripts ("ok - sentence"). A program that failed without a
# failed case (it crashed, or ran out of time) counts as one failed case, and so does one that ran no case at all.
# A skipped case of cmocka has the line that it printed last as its reason.
# The output of failed programs goes to standard error.

/^ *[0-9]+\/[0-9]+ Test +#[0-9]+:/ {
    program = $0
    sub(/^ *[0-9]+\/[0-9]+ Test +#/, "", program)
    id = program
    sub(/:.*/, "", id)
    sub(/^[0-9]+: /, "", program)
    sub(/ .*/, "", program)
    ended = 1
    good = $0 ~ / Passed +[0-9.]+ sec$/
    for (i = 0; i < n_case[id]; i++) {
        split(cases[id, i], part, "\t")
        print part[1], preset, program ": " part[2]
    }
    if (!good && !n_failed[id])
        print "failed", preset, program ": ended with " verdict($0)
    if (good && !n_case[id])
        print "failed", preset, program ": ran no test case"
    if (!good || n_failed[id] || !n_case[id])
        printf "%s", output[id] | "cat 1>&2"
    next
}

/^[0-9]+: / {
    id = $0
    sub(/:.*/, "", id)
    line = substr($0, length(id) + 3)
    output[id] = output[id] "    " line "\n"
    if (line ~ /^\[=+\] [0-9]+ test\(s\) run/)
        summed_up[id] = 1
    if (line ~ /^\[ RUN +\] /)
        reason[id] = ""
    else if (line !~ /^\[/)
        reason[id] = line
    if (line ~ /^\[ +OK \] /)
        add(id, "passed", substr(line, 14))
    else if (line ~ /^\[  SKIPPED \] / && !summed_up[id])
        add(id, "skipped", substr(line, 14) (reason[id] != "" ? " (" reason[id] ")" : ""))
    else if (line ~ /^\[  FAILED  \] / && !summed_up[id])
        add(id, "failed", substr(line, 14))
    else if (line ~ /^\[=+\] Running /)
        summed_up[id] = 0
    else if (line ~ /^ok - /)
        add(id, "passed", substr(line, 6))
    else if (line ~ /^skipped - /)
        add(id, "skipped", substr(line, 11))
    else if (line ~ /^not ok - /)
        add(id, "failed", substr(line, 10))
}

/^[0-9]+% tests passed, / {
    finished = 1
}

END {
    if (!ended)
        print "failed", preset, "no test ran"
    else if (!finished)
        print "failed", preset, "the test run was cut short"
}

function add(id, result, name) {
    cases[id, n_case[id]++] = result "\t" name
    if (result == "failed")
        n_failed[id]++
}

function verdict(line) {
    sub(/.*\*\*\*/, "", line)
    return line
}
