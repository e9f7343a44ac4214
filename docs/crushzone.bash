# Completion of crushzone for bash. Printed by crushzone help --completion bash.
_crushzone() {
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} words='' options=''
    COMPREPLY=()
    if [ "$COMP_CWORD" = 1 ]; then
        words='run check optimise sweep sample merge pareto challenge corridor dakota export explain verify bench serve report plot compare validate show profile fit new schema help version'
        COMPREPLY=($(compgen -W "$words" -- "$word"))
        return
    fi
    case $before in
    --output | -o) COMPREPLY=($(compgen -f -- "$word")); return ;;
    --set) return ;;
    --scenario) return ;;
    --time-step-ms) return ;;
    --integrator) words='zhai erk adams' ;;
    --depfile) COMPREPLY=($(compgen -f -- "$word")); return ;;
    --junit) COMPREPLY=($(compgen -f -- "$word")); return ;;
    --problem) COMPREPLY=($(compgen -f -- "$word")); return ;;
    --sqlite) COMPREPLY=($(compgen -f -- "$word")); return ;;
    --vary) words='PATH=A:B:N A,B,C' ;;
    --minimise) return ;;
    --points | -n) return ;;
    --metric) return ;;
    --check) return ;;
    --what) words='fd shares energy balance force velocity acceleration car-acceleration siv displacement shortening lift overlap pitch frames panels' ;;
    --at) return ;;
    --measured) COMPREPLY=($(compgen -f -- "$word")); return ;;
    --column) return ;;
    --svg) COMPREPLY=($(compgen -f -- "$word")); return ;;
    --algorithm) return ;;
    --evaluations) return ;;
    --seed) return ;;
    --width) return ;;
    --resume) COMPREPLY=($(compgen -f -- "$word")); return ;;
    --max-time) return ;;
    --runs) return ;;
    --samples | -n) return ;;
    --shard) return ;;
    --part) return ;;
    --curves | -n) return ;;
    --jobs | -j) return ;;
    --rounds) return ;;
    --category) return ;;
    --as) return ;;
    --basis) words='static dynamic' ;;
    --stages) return ;;
    --name) return ;;
    --stroke) return ;;
    --force) return ;;
    --stroke-unit) return ;;
    --force-unit) return ;;
    --zero) words='start contact STROKE' ;;
    --flip) words='stroke force both' ;;
    --scale) return ;;
    --from) return ;;
    --to) return ;;
    --csv-sep) return ;;
    --csv-decimal) return ;;
    --color) words='auto always never' ;;
    --completion) return ;;
    esac
    if [ -n "$words" ]; then
        COMPREPLY=($(compgen -W "$words" -- "$word"))
        return
    fi
    case ${COMP_WORDS[1]} in
    run) options='--output --force --json --quiet --verbose --set --scenario --time-step-ms --integrator --iso-mme --depfile --junit --strict --jobs --csv-sep --csv-decimal --color --help' ;;
    check) options='--output --force --json --quiet --verbose --set --scenario --time-step-ms --integrator --depfile --junit --jobs --csv-sep --csv-decimal --color --help' ;;
    optimise | optimize) options='--output --json --quiet --verbose --set --time-step-ms --depfile --algorithm --evaluations --seed --width --resume --max-time --jobs --csv-sep --csv-decimal --color --help' ;;
    sweep) options='--output --force --json --quiet --set --scenario --time-step-ms --junit --strict --vary --metric --check --shard --jobs --csv-sep --csv-decimal --color --help' ;;
    sample) options='--output --force --json --quiet --set --time-step-ms --junit --seed --samples --shard --jobs --csv-sep --csv-decimal --color --help' ;;
    merge) options='--output --force --json --quiet --junit --jobs --csv-sep --csv-decimal --color --help' ;;
    pareto) options='--output --force --json --quiet --verbose --set --time-step-ms --minimise --points --algorithm --evaluations --seed --width --resume --max-time --jobs --csv-sep --csv-decimal --color --help' ;;
    challenge) options='--output --force --json --quiet --set --time-step-ms --seed --runs --jobs --csv-sep --csv-decimal --color --help' ;;
    corridor) options='--output --force --json --quiet --set --time-step-ms --seed --part --curves --no-scatter --jobs --csv-sep --csv-decimal --color --help' ;;
    dakota) options='--quiet --set --scenario --time-step-ms --problem --jobs --color --help' ;;
    export) options='--quiet --sqlite --help' ;;
    explain) options='--json --quiet --set --scenario --time-step-ms --check --jobs --color --help' ;;
    verify) options='--json --quiet --verbose --set --scenario --time-step-ms --jobs --color --help' ;;
    bench) options='--json --quiet --set --scenario --time-step-ms --rounds --color --help' ;;
    serve) options='--quiet --set --scenario --time-step-ms --jobs --color --help' ;;
    report) options='--output --quiet --scenario --jobs --help' ;;
    plot) options='--quiet --set --scenario --vary --what --at --measured --column --svg --jobs --csv-sep --csv-decimal --help' ;;
    compare) options='--output --json --quiet --scenario --jobs --color --help' ;;
    validate) options='--json --quiet --set --color --help' ;;
    show) options='--quiet --set --scenario --time-step-ms --svg --color --help' ;;
    profile) options='--category --help' ;;
    fit) options='--json --svg --as --basis --stages --name --stroke --force --stroke-unit --force-unit --zero --flip --scale --from --to --csv-sep --csv-decimal --help' ;;
    new) options='--output --quiet --category --help' ;;
    schema) options='--help' ;;
    help) options='--markdown --man --completion --help' ;;
    version) options='--json --help' ;;
    esac
    if [[ $word == -* ]]; then
        COMPREPLY=($(compgen -W "$options" -- "$word"))
    elif [ "${COMP_WORDS[1]}" = help ]; then
        COMPREPLY=($(compgen -W 'keys units checks verdicts profiles parts paths algorithms channels results events figures files exit-codes run check optimise sweep sample merge pareto challenge corridor dakota export explain verify bench serve report plot compare validate show profile fit new schema help version' -- "$word"))
    elif [ "${COMP_WORDS[1]}" != new ]; then
        COMPREPLY=($(compgen -f -- "$word"))
    else
        COMPREPLY=($(compgen -W 'two-trains buffer-stop wagon override en15227 us-49cfr238 cn-metro' -- "$word"))
    fi
}
complete -o filenames -F _crushzone crushzone
