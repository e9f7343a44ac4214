# The commands that a page shows. Source it after cases.sh.
#
# Commands are the lines of its blocks that begin with "$ "; a line "# exit code N" right after the block's command says
# this exit code. Lines between commands are their output: each must be in the real output, except for
# numbers of seconds. A block is fenced by ```sh, or by ```sh and a word where its commands need a cluster or a tool.
commands_of() { # commands_of PAGE FENCE: one file command.N per command, shown output in shown.N
    awk -v fence="\`\`\`$2" '
        $0 == fence { inside = 1; next }
        /^```/ { inside = 0; next }
        inside && /^\$ / { n++; print substr($0, 3) > ("command." n); printf "" > ("shown." n); next }
        inside && n { print > ("shown." n) }
        END { print n + 0 }' "$1"
}
run_as_shown() { # run_as_shown N
    want=$(sed -n 's/^# exit code \([0-9]*\)$/\1/p' "../shown.$1")
    sh "../command.$1" >"../real.$1" 2>&1
    code=$?
    cat "../real.$1"
    [ "$code" = "${want:-0}" ] || { echo "exit code $code instead of ${want:-0}"; return 1; }
    without_seconds <"../real.$1" >../real
    grep -v '^# exit code ' "../shown.$1" | without_seconds | while read -r line; do
        case $line in '' | ...) continue ;; esac
        grep -qxF -- "$line" ../real || { echo "not printed: $line"; exit 1; }
    done
}
without_seconds() {
    sed 's/[0-9.]* m\{0,1\}s\b/N s/g; s/^ *//; s/ *$//'
}
