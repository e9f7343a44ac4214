# The tree satisfies its rules.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/structure/rules.sh"
cd "$SOURCE"

nothing "include arrows go one way" include_arrows
nothing "headers of a folder do not include one another in a circle" header_circles
nothing "sources of the reader do not call one another in a circle" call_circles
nothing "macros of the kernel use only their parameters" macros_with_locals
nothing "no row is counted from another one" arithmetic_on_rows
nothing "angles and arms are only in the parts that line up or put" angles_in_laws
nothing "each third-party header is named in one file" third_party_headers
nothing "every source is in its folder's list and every listed source exists" unlisted_sources
nothing "every test is in its folder's list" unlisted_tests
[ ! -x "$PROGRAM" ] || nothing "every header is included" unused_headers
nothing "no file has a vague name" vague_names
nothing "no file is longer than 500 lines" long_files
nothing "no channel is looked up by a text" channels_by_text
nothing "the report computes nothing while it draws" report_that_computes
nothing "keys of the results are in the lists alone" keys_by_hand
nothing "the library does not print, exit, or depend on locale and environment" library_manners
nothing "doubles are not compared as floats" float_comparisons
nothing "every tolerance has its reason" bare_tolerances
nothing "no parameter of a law and no angle is read outside dynamics" mechanics_outside_dynamics
nothing "every file begins with its purpose" missing_purposes
nothing "the changelog contains the version" changelog_gaps
nothing "public headers stand on their own" headers_that_need_others
nothing "scripts are POSIX shell" broken_scripts
if command -v clang-format >/dev/null 2>&1; then
    nothing "sources have the layout of clang-format" unformatted_files
else
    skipped "sources have the layout of clang-format" "no clang-format here"
fi
finish
