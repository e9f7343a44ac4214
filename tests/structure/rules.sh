# The rules of the tree, each a function that prints the offenders, one a line; run from the project's root.

library_folders="base statistics laws text tree problem model fit dynamics integrate simulate evaluate optimise report serve"
folders="$library_folders cli"
c_files() { # c_files FOLDER...: all C sources, headers and lists in them
    find "$@" -type f \( -name '*.c' -o -name '*.h' -o -name '*.def' \) 2>/dev/null | sort
}

# Arrows between the folders go one way: cli, serve, report, optimise, evaluate, simulate, dynamics, fit, model, problem, tree, text, base.
# dynamics, model and fit include laws, which includes nothing; simulate and dynamics include integrate, which includes base;
# evaluate, optimise and report include statistics, which includes base.
include_arrows() {
    for folder in $folders; do
        for file in $(c_files src/$folder); do
            awk -v from=$folder '
                BEGIN {
                    n = split("base text tree problem model fit dynamics simulate evaluate optimise report serve cli", order, " ")
                    for (i = 1; i <= n; i++) { rank[order[i]] = i; public[order[i]] = order[i] }
                    public["status"] = public["names"] = "base"
                    public["channel"] = public["parts"] = "problem"
                    public["challenge"] = "optimise"
                    public["corridor"] = "optimise"
                    public["executor"] = public["benchmark"] = public["sample"] = public["sweep"] = public["explain"] = public["verify"] = "evaluate"
                    public["robust"] = public["pareto"] = "optimise"
                    public["crushzone"] = public["dakota"] = "serve"
                    public["shards"] = "report"
                }
                /^[ \t]*#[ \t]*include[ \t]*"/ {
                    split($0, part, "\"")
                    if (split(part[2], path, "/") != 2) { offend(); next }
                    to = path[1]
                    if (to == "crushzone" && path[2] ~ /\.h$/) {
                        sub(/\.h$/, "", path[2])
                        to = public[path[2]]
                    } else if (to == "crushzone")
                        next # closed lists that everybody may expand
                    if (to == from) next
                    if (from == "laws") { offend(); next }
                    if (to == "laws") { if (from != "dynamics" && from != "model" && from != "fit") offend(); next }
                    if (from == "integrate" || from == "statistics") { if (to != "base") offend(); next }
                    if (to == "integrate") { if (from != "simulate" && from != "dynamics") offend(); next }
                    if (to == "statistics") { if (from != "evaluate" && from != "optimise" && from != "report") offend(); next }
                    if (!(to in rank) || rank[to] > rank[from]) offend()
                }
                function offend() { print FILENAME ":" FNR ": " $0 }' "$file"
        done
    done
}

# names_on_circles: of "from to" lines, the names that lead back to themselves, sorted.
names_on_circles() {
    awk '{ next_of[$1] = next_of[$1] " " $2 }
        function follow(name, part, n, i) {
            n = split(next_of[name], part, " ")
            for (i = 1; i <= n; i++)
                if (!(part[i] in seen)) { seen[part[i]]; follow(part[i]) }
        }
        END { for (name in next_of) { split("", seen); follow(name); if (name in seen) print name } }' | sort
}

# Within a folder, headers include one another without a circle; a header and the source of its name are one.
header_circles() {
    for folder in $folders; do
        c_files src/$folder | grep '\.[ch]$' | xargs awk -v folder=$folder '
            /^[ \t]*#[ \t]*include[ \t]*"/ {
                split($0, part, "\""); split(part[2], path, "/")
                n = split(FILENAME, own, "/"); from = own[n]
                sub(/\.[ch]$/, "", from)
                if (path[1] == folder && sub(/\.h$/, "", path[2]) && path[2] != from) print from, path[2]
            }' /dev/null | names_on_circles | sed "s,.*,src/$folder/& includes what includes it,"
    done
}

# The sources of these folders do not call one another in a circle either, through whatever header.
call_circles() {
    for folder in text tree problem fit report serve cli; do
        list=$(c_files src/$folder | grep '\.c$')
        [ -n "$list" ] || continue
        awk '
            FNR == 1 { n = split(FILENAME, own, "/"); from = own[n]; sub(/\.c$/, "", from); pass += FILENAME == ARGV[1] }
            pass == 1 && /^[A-Za-z].*cz_[a-z0-9_]*\(/ && !/^static/ { name = $0; sub(/\(.*/, "", name); sub(/.*[^a-z0-9_]/, "", name) }
            pass == 1 && name != "" && /[{;]$/ { if (/\{$/) home[name] = from; name = "" }
            pass == 2 {
                line = $0
                while (match(line, /cz_[a-z0-9_]*/)) {
                    used = substr(line, RSTART, RLENGTH)
                    if (used in home && home[used] != from) print from, home[used]
                    line = substr(line, RSTART + RLENGTH)
                }
            }' $list $list | names_on_circles | sed "s,.*,src/$folder/&.c calls what calls it,"
    done
}

# A macro of the kernel uses its parameters, types, constants (capital letters) and functions of the project,
# and no name of the place that it is used in. (The copy of the kernel for every processor is called baseline.)
macros_with_locals() {
    c_files src/dynamics src/laws | xargs awk '
        /^[ \t]*#[ \t]*define[ \t]/ { macro = ""; first = FNR; inside = 1 }
        inside {
            line = $0
            inside = sub(/\\[ \t]*$/, "", line)
            macro = macro " " line
            if (!inside) judge(macro)
        }
        function judge(text,   given, name, part, n, i) {
            split("", given)
            gsub(/"[^"]*"/, "", text); gsub(/\/\*.*\*\//, "", text)
            gsub(/[0-9][0-9.]*[eE][-+]?[0-9]+|0x[0-9a-fA-F]+/, "", text)
            sub(/^[ \t]*#[ \t]*define[ \t]+[A-Za-z0-9_]+/, "", text)
            if (text ~ /^\(/) {
                n = split(substr(text, 2, index(text, ")") - 2), part, /[ ,]+/)
                for (i = 1; i <= n; i++) given[part[i]]
                text = substr(text, index(text, ")") + 1)
            }
            if (match(text, /size_t [a-z]+ = 0/)) given[substr(text, RSTART + 7, RLENGTH - 11)]
            n = split(text, part, /[^A-Za-z0-9_]+/)
            for (i = 1; i <= n; i++) {
                name = part[i]
                if (name !~ /^[a-z]/ || name in given || name ~ /^cz_/) continue
                if (name ~ /^(int|char|double|size_t|for|if|sizeof|offsetof|omp|simd|reduction|max|baseline)$/) continue
                print FILENAME ":" first ": a macro uses " name ", which it is not given"
            }
        }'
}

# A row of the model or the kernel has a name of its own: none is counted from another.
arithmetic_on_rows() {
    c_files src/model src/dynamics src/simulate tests | xargs grep -HnE \
        'CZ_(DOF|PARAMETER|MEMORY|LEDGER|EXTREME|PUBLISHED|CURVE)\([^()]*\) *[-+*%]|[-+*%] *CZ_(DOF|PARAMETER|MEMORY|LEDGER|EXTREME|PUBLISHED|CURVE)\('
}

# Angles, arms and directions are used only in the parts of the kernel that line up or put: kernel_carrier.h, which defines
# how bodies move, and the kernel_*_line.h of the elements. Messages between cars and the rail have shapes of their own.
angles_in_laws() {
    c_files src/dynamics | grep '/kernel[_a-z]*\.[ch]$' | grep -vE '/kernel_(carrier|neighbours|track|[a-z_]*_line)\.h$' |
        xargs grep -HnwE 'cosine|sine|turned|arm_x|arm_z|normal_x|normal_z|direction_x|direction_z' | without_comments
}

# A third-party library is named in one file, so that it can be replaced.
third_party_headers() {
    for header in mpi.h nlopt.h yaml.h jansson.h sqlite3.h 'cvode/' 'arkode/' 'kinsol/' 'sundials/' pthread.h getopt.h; do
        files=$(grep -rlE "#[[:space:]]*include[[:space:]]*[<\"]$header" src include)
        [ "$(echo "$files" | wc -l)" -le 1 ] || echo "$header in" $files
    done
}

# Every source is in its folder's list, and every list names existing files.
unlisted_sources() {
    for folder in $folders; do
        for file in $(find src/$folder -name '*.c' | sort); do
            name=${file#src/$folder/}
            [ "$file" = src/dynamics/kernel.c ] && continue # compiled once per instruction set by CMakeLists.txt
            grep -qx "    $name" src/$folder/sources.cmake || echo "$file is not in src/$folder/sources.cmake"
        done
        sed -n 's/^    \([^ ]*\.c\)$/\1/p' src/$folder/sources.cmake | while read -r name; do
            [ -f "src/$folder/$name" ] || echo "src/$folder/sources.cmake names $name, which is not there"
        done
    done
    for folder in src/*/; do
        case " $folders " in *" $(basename "$folder") "*) ;; *) echo "$folder is not a folder of the project" ;; esac
    done
}

unlisted_tests() {
    for file in $(find tests -type f \( -name '*.c' -o -name '*.sh' \) ! -path 'tests/support/*' | sort); do
        folder=$(dirname "$file" | cut -d/ -f1-2)
        name=$(basename "$file")
        grep -qwF "$name" "$folder/tests.cmake" 2>/dev/null && continue
        grep -rqwF "$file" tests --include=tests.cmake && continue # named by its path in another folder
        case $name in test_*.c) grep -q '^cz_tests(' "$folder/tests.cmake" 2>/dev/null && continue ;; esac
        grep -rqwF "$name" "$folder" --include='*.sh' && continue # sourced or run by a listed script
        echo "$file is not in $folder/tests.cmake"
    done
}

# Every header and list is included somewhere.
unused_headers() {
    for file in $(find src include -type f \( -name '*.h' -o -name '*.def' \) | sort); do
        [ "$file" = include/crushzone/crushzone.h ] && continue # the umbrella is for users
        name=$(echo "$file" | sed 's,^src/,,; s,^include/,,')
        grep -rqF "#include \"$name\"" src include tests || echo "$file is included by nobody"
    done
}

vague_names() {
    find src include tests examples -type f 2>/dev/null | grep -E '(^|[/_-])(util|utils|common|misc|helper|helpers)([._-]|$)'
}

long_files() {
    for file in $(c_files src include tests examples); do
        n=$(wc -l <"$file")
        [ "$n" -le 500 ] || echo "$file has $n lines, 500 are allowed"
    done
}

# A channel is a quantity at a place: no folder knows one by a text, and names are made where they are written or read.
channels_by_text() {
    entries=$(grep '^CZ_CHANNEL(' include/crushzone/channels.def)
    stems=$(echo "$entries" | cut -d'"' -f2 | sed 's/{.*//' | sort -u | paste -sd'|' -)
    units=$(echo "$entries" | cut -d'"' -f4 | sort -u | paste -sd'|' -)
    for folder in $folders; do
        c_files src/$folder
    done | xargs grep -HnE "\"($stems)([^\" ]*_($units))?\"" | without_comments | grep -v '^src/report/drawn.def:'
    grep -rlE '(^|[^_a-z])cz_(channel|drawn)_name\(' src --include='*.c' |
        grep -vxE 'src/(problem/(channel|rules_names)|report/(chart_draw|csv|drawn|iso_mme|page_data)|cli/help_topics)\.c' |
        sed 's/$/ makes names of channels/'
    grep -rnE '(str(n)?(cmp|str|chr)|fnmatch)\(.*(channel|drawn)_name' src --include='*.c' | grep -v '^src/problem/channel.c:'
}

# The report computes nothing: the data of models and simulation that it needs beside results are collected in these files before
# anything is drawn.
report_that_computes() {
    grep -HnE '#[[:space:]]*include[[:space:]]*"(simulate|dynamics|integrate|laws)/|(^|[^_a-z])(cz_model_build|cz_simulate|cz_evaluate|cz_optimise)\(' \
        src/report/*.[ch] | grep -vE '^src/report/(page_collect|drawn|standalone_figure)\.c:'
}

# The library returns statuses: it neither prints nor ends the program, and reads no locale and no environment. Text becomes
# a number in one place, which sets the locale aside.
library_manners() {
    for folder in $library_folders; do
        c_files src/$folder
    done | xargs grep -HnE '(^|[^_a-z0-9A-Z"])(printf|puts|putchar|perror|exit|_exit|abort|system|popen|setlocale|getenv|rand|srand|atof|strtod)[[:space:]]*\(' |
        without_comments | grep -v '^src/base/number.c:.*strtod'
    for folder in $library_folders; do
        c_files src/$folder
    done | xargs grep -HnE '(^|[^_a-z0-9A-Z])(stdout|stderr)([^_a-z0-9A-Z]|$)' | without_comments
}
without_comments() {
    grep -vE '^[^:]*:[0-9]*:[[:space:]]*(/?\*|//)'
}

# cmocka's comparison of floats is one of float, not of double.
float_comparisons() {
    c_files tests | xargs grep -HnE 'assert_(not_)?(float|double)_(not_)?(equal)' | grep -v '^tests/support/check.h:'
}

# A tolerance has its reason: a name that says it (check.h has those of rounding), or a comment at the comparison, up to six
# lines before it, or above the function.
bare_tolerances() {
    c_files tests | grep '\.[ch]$' | xargs awk '
        FNR == 1 { call = ""; commented = -9; explained = 0; before = "" }
        /^[A-Za-z]/ { explained = before ~ /\*\/$/; start = FNR }
        /\/\*|\*\// { commented = FNR }
        { before = $0 }
        call == "" && /assert_near\(/ && !/#[ \t]*define/ { call = substr($0, index($0, "assert_near(") + 12); first = FNR; judge(); next }
        call != "" { call = call " " $0; judge() }
        function judge(   i, c, depth, n, part) {
            n = depth = 0; split("", part)
            for (i = 1; i <= length(call); i++) {
                c = substr(call, i, 1)
                if (c ~ /[(\[{]/) depth++
                if (c ~ /[)\]}]/ && --depth < 0) break
                if (c == "," && depth == 0) n++; else part[n] = part[n] c
            }
            if (depth >= 0) return # the call goes on
            call = ""
            if (is_bare(part[2]) + is_bare(part[3]) > 0 && !explained && (commented < first - 6 || commented < start))
                print FILENAME ":" first ": a tolerance without a reason:" part[2] "," part[3]
        }
        function is_bare(text) {
            gsub(/[A-Za-z_][A-Za-z_0-9]*|\[[^\]]*\]/, "", text)
            return text ~ /[1-9]/
        }'
}

# Mechanical results of a run come from values that the kernel publishes, or from functions of dynamics: the folders that simulate,
# judge and report read no parameter of a law and no sine or cosine of a body.
mechanics_outside_dynamics() {
    for folder in simulate evaluate optimise report serve cli; do
        c_files src/$folder | xargs grep -HnE 'CZ_PARAMETER|cz_lane_(parameter|at|block)\(|(\.|->)turned\b|\b(sin|cos|tan)\(' /dev/null |
            grep -vE ':[0-9]+: +\* ' # the text of a comment
    done
}

# The first line of every file gives its purpose.
missing_purposes() {
    for file in $(c_files src include tests examples); do
        head -n 1 "$file" | grep -qE '^(/\*|//) ?[^ ]' || echo "$file:1: does not begin with a comment that says what it is for"
    done
}

# The changelog contains the version of the project.
changelog_gaps() {
    version=$(sed -n 's/^project(crushzone VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
    [ -n "$version" ] || echo "CMakeLists.txt: project() has no version"
    grep -qE "^## \[(Unreleased|$version)\]" CHANGELOG.md || echo "CHANGELOG.md has neither [Unreleased] nor [$version]"
}

# Public headers stand on their own, in C and in C++ linkage.
headers_that_need_others() {
    for file in include/crushzone/*.h; do
        echo "#include \"crushzone/$(basename "$file")\"" |
            ${CC:-cc} -std=c11 -Wall -Wextra -Wstrict-prototypes -Werror -Iinclude -fsyntax-only -x c - 2>&1 |
            sed "s,^,$(basename "$file"): ,"
        ! grep -q CZ_API "$file" || grep -qx CZ_BEGIN_DECLARATIONS "$file" || echo "$file lacks CZ_BEGIN_DECLARATIONS"
    done
}

unformatted_files() {
    find src include tests examples -type f \( -name '*.c' -o -name '*.h' \) 2>/dev/null | sort |
        xargs clang-format --style=file --dry-run 2>&1 |
        sed -n "s/^\([^:]*\):[0-9].*code should be clang-formatted.*/\1 differs from clang-format's layout/p" | uniq
}

# Scripts are POSIX shell.
broken_scripts() {
    for file in demo test .ci/run $(find scripts -type f ! -name '*.awk' 2>/dev/null) \
        $(find tests examples -name '*.sh' 2>/dev/null); do
        sh -n "$file" 2>&1
    done
}

# A key of the results is in the lists of results and nowhere else: one file writes JSON, and no other names a key with its
# unit.
keys_by_hand() {
    for folder in report serve cli; do c_files src/$folder; done | grep -v '\.def$' |
        xargs grep -HnE '#[[:space:]]*include[[:space:]]*"report/json.h"' | grep -v '^src/report/\(results\|json\)\.c:'
    c_files src/report | grep -v '\.def$' | xargs grep -HnE '"[a-z0-9_]+_(kN|mm|kJ|ms|mrad|km_h|kNs|kNms)"' | without_comments
}
