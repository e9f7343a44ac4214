# The commands in "RUN:" lines of examples and problem files run as written.
. "$SOURCE/tests/support/cases.sh"
ln -s "$SOURCE/problems" problems
PATH=$BUILD/examples:$SOURCE/examples:$BUILD:$PATH
export PATH

run_lines() { # run_lines: "file<TAB>command" of each RUN line
    for file in "$SOURCE"/examples/*.c "$SOURCE"/examples/*.sh "$SOURCE"/problems/*.yaml; do
        sed -n "s,^\(//\|#\) RUN: ,$(basename "$file")\t,p" "$file"
    done
}
without_run_line() {
    for file in "$SOURCE"/examples/*.c "$SOURCE"/examples/*.sh "$SOURCE"/problems/*.yaml; do
        grep -qE '^(//|#) RUN: ' "$file" || echo "$file has no RUN: line"
    done
}
too_long() {
    for file in "$SOURCE"/examples/*.c; do
        [ "$(wc -l <"$file")" -lt 100 ] || echo "$file has 100 lines or more"
    done
}

nothing "every example and every shipped problem has a RUN line, which an incomplete run would fail" without_run_line
nothing "every example program has fewer than 100 lines" too_long
run_lines >lines.txt
while IFS="$(printf '\t')" read -r file command; do
    check "$file: $command" sh -c "$command"
done <lines.txt
finish
