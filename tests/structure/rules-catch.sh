# Each rule of rules.sh finds its fault in a small tree that has it.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/structure/rules.sh"

put() { # put FILE TEXT
    mkdir -p "$(dirname "$1")"
    printf '%b\n' "$2" >"$1"
}
finds() { # finds WORD COMMAND
    "$2" >found.txt 2>&1
    cat found.txt
    grep -q "$1" found.txt
}

put src/base/number.c '/* n */\n#include "model/model.h"'
put src/base/sources.cmake 'set(CZ_SOURCES_base\n    gone.c\n)'
put src/laws/tube.h '/* n */\n#include "base/arena.h"'
put src/report/table.c '/* n */\n#include "laws/tube.h"\nvoid f(void) {\n    printf("x");\n}'
put src/report/other.c '#include <nlopt.h>'
put src/optimise/adapter.c '/* n */\n#include <nlopt.h>'
put src/cli/helpers.c '/* n */\n#include "report/table.h"'
put src/statistics/share.c '/* n */\n#include "model/model.h"'
put src/problem/draws.c '/* n */\n#include "statistics/share.h"'
put src/evaluate/draws.c '/* n */\n#include "statistics/share.h"'
put src/integrate/step.c '/* n */\n#include "crushzone/model.h"'
put src/model/list.c '/* n */\n#include "crushzone/events.def"\n#include "crushzone/problem.h"\n#include "laws/tube.h"'
put src/physics/new.c '/* n */'
put tests/model/test_list.c '/* n */\nassert_float_equal(a, b, 0.1);'
put tests/model/tests.cmake ''
put include/crushzone/model.h '/* n */\nsize_t cz_model_size(void);'
put CMakeLists.txt 'project(crushzone VERSION 2.3.4 LANGUAGES C'
put CHANGELOG.md '## [2.3.3]'
put include/crushzone/channels.def '/* n */\nCZ_CHANNEL(A, VEHICLE, PLANE, ANY, "x_{vehicle}_m", "m", "", "")\nCZ_CHANNEL(B, RUN, PLANE, TOTAL, "E_kinetic_kJ", "kJ", "", "")'
put src/evaluate/curves.c '/* n */\nfind(run, "x_A1_m");\nfind(run, "E_kinetic_kJ");\nfind(run, "length");'
put src/report/loops.c '/* n */\nif (strcmp(cz_channel_name(info, 0, "", text), wanted) == 0)'
put src/report/bars.c '/* n */\n#include "simulate/filter.h"\nstatus = cz_model_build(problem, 0, &model, error);'
put demo 'if then'
awk 'BEGIN { print "/* n */"; for (i = 0; i < 500; i++) print "int a;" }' >src/base/long.c

for file in src/base/number.c:2 src/laws/tube.h:2 src/report/table.c:2 src/integrate/step.c:2 src/statistics/share.c:2 src/problem/draws.c:2; do
    check "an include against the arrows is found: $file" finds "^$file:" include_arrows
done
check "includes along the arrows are accepted" sh -c '! grep -qE "src/(model|cli)/" found.txt'
put src/base/ring.h '/* n */\n#include "base/chain.h"'
put src/base/chain.c '/* n */\n#include "base/link.h"'
put src/base/chain.h '/* n */'
put src/base/link.h '/* n */\n#include "base/ring.h"\n#include "base/chain.h"'
put src/base/lock.h '/* n */\n#include "base/ring.h"'
put src/tree/oak.c '/* n */\nint cz_oak(int a,\n           int b) {\n    return cz_elm(a);\n}'
put src/tree/elm.c '/* n */\nint cz_elm(int a) {\n    return cz_oak(a, 1) + cz_ash(a);\n}'
put src/tree/ash.c '/* n */\nint cz_ash(int a) {\n    return a;\n}'
for name in ring chain link; do
    check "a header on a circle is found: $name.h" finds "^src/base/$name includes" header_circles
done
check "a header that only leads to a circle is accepted" sh -c '! grep -q lock found.txt'
for name in oak elm; do
    check "a circle of calls between sources is found: $name.c" finds "^src/tree/$name.c calls" call_circles
done
check "a source that is only called is accepted" sh -c '! grep -q ash found.txt'
put src/dynamics/kernel_end.h '/* n */\n#define ROW(name) block->name\n#define EACH(i) for (size_t i = 0; i < N; ++i)\n#define TEXT(a) "block" #a /* block */\n#define LONG(a) \\\n    (a + hidden)\nstatic void f(void) {\n    force[i] *= turned->sine[i];\n}'
put src/dynamics/kernel_end_line.h '/* n */\nstatic void g(void) {\n    force[i] *= cosine[i];\n}'
check "a macro that uses a local is found" finds '^src/dynamics/kernel_end.h:2: .* block' macros_with_locals
check "a macro of two lines that uses a local is found" finds '^src/dynamics/kernel_end.h:5: .* hidden' macros_with_locals
check "a macro that uses its parameters is accepted" sh -c '! grep -qE ":(3|4):" found.txt'
check "an angle in a law is found" finds '^src/dynamics/kernel_end.h:8:' angles_in_laws
check "an angle in a part that puts is accepted" sh -c '! grep -q _line.h found.txt'
put src/simulate/rows.c '/* n */\nint a = CZ_MEMORY(tube) + side;\nint b = 3 * CZ_DOF(end[side].x);\nint c = CZ_DOF(end[side + 1].x);'
for line in 2 3; do
    check "a row that is counted from another is found: line $line" finds "^src/simulate/rows.c:$line:" arithmetic_on_rows
done
check "a row by its own name is accepted" sh -c '! grep -q :4: found.txt'
check "a third-party header in two files is found" finds 'nlopt.h in src/' third_party_headers
check "a source outside its list is found" finds '^src/base/number.c is not in' unlisted_sources
check "a listed source that is missing is found" finds 'names gone.c' unlisted_sources
check "a folder outside the plan is found" finds '^src/physics/ is not' unlisted_sources
check "a test outside its list is found" finds '^tests/model/test_list.c is not' unlisted_tests
put src/model/lonely.h '/* n */'
check "a header that is not included is found" finds '^src/model/lonely.h is' unused_headers
check "a vague name is found" finds 'src/cli/helpers.c' vague_names
check "a file of 501 lines is found" finds '^src/base/long.c has 501' long_files
for place in src/evaluate/curves.c:2 src/evaluate/curves.c:3 'src/report/loops.c makes' src/report/loops.c:2; do
    check "a channel that is looked up by a text is found: $place" finds "^$place" channels_by_text
done
check "a text that is not a channel is accepted" sh -c '! grep -q curves.c:4 found.txt'
for line in 2 3; do
    check "a computation in the report is found: line $line" finds "^src/report/bars.c:$line:" report_that_computes
done
put src/report/by_hand.c '/* n */\n#include "report/json.h"\nput(table, "peak_force_kN");\nput(table, "peak force kN");'
for line in 2 3; do
    check "a key of the results that is written by hand is found: line $line" finds "^src/report/by_hand.c:$line:" keys_by_hand
done
check "a heading is accepted" sh -c '! grep -q by_hand.c:4 found.txt'
check "printing in the library is found" finds '^src/report/table.c:4:' library_manners
put src/simulate/bends.c '/* n */
CzLane a = cz_lane_at(lanes, car);
double b = *cz_lane_parameter(lanes, CZ_PARAMETER(tilts), lane);
double c = block->turned.body.sine[0];
double d = sin(pitch);
double e = cz_published(batch, row, lane);'
put src/dynamics/bends.c '/* n */
CzLane a = cz_lane_at(lanes, car);'
mechanics_outside_dynamics >bends.txt
for line in 2 3 4 5; do
    check "mechanics outside dynamics is found: line $line" grep -q "^src/simulate/bends.c:$line:" bends.txt
done
check "values that the kernel publishes are accepted" sh -c '! grep -qE "bends.c:6|src/dynamics" bends.txt'
check "a comparison of floats is found" finds '^tests/model/test_list.c:2:' float_comparisons
put tests/model/test_near.c '/* n */\n\nstatic void f(void) {\n    assert_near(a[2], b(1, 2), 1e-3,\n                0.0);\n    assert_near(a, b, NAMED, 0.0);\n    assert_near(a, b, 1e-3, 0.0); /* half a digit */\n}\n\n/* To a step. */\nstatic void g(void) {\n    assert_near(a, b, 0.0, 0.5 * step);\n}\nstatic void h(void) {\n    assert_near(a, b, 0.0, 2.0 * step);\n}'
bare_tolerances >bare.txt
for line in 4 15; do
    check "a tolerance without a reason is found: line $line" grep -q "^tests/model/test_near.c:$line:" bare.txt
done
check "a tolerance with a name or a comment is accepted" sh -c '! grep -qE "test_near.c:(6|7|12):" bare.txt'
check "a file without a purpose is found" finds '^src/report/other.c:1:' missing_purposes
check "a version without a changelog entry is found" finds '2.3.4' changelog_gaps
check "a header that needs another is found" finds 'model.h: ' headers_that_need_others
check "a broken script is found" finds 'demo' broken_scripts
if command -v clang-format >/dev/null 2>&1; then
    put src/base/wide.c '/* n */\nint   wide;'
    check "an unusual layout is found" finds 'src/base/wide.c differs' unformatted_files
fi
finish
