# docs/verification.md is up to date, and every row of it is within its tolerance.
. "$SOURCE/tests/support/cases.sh"
cd "$SOURCE"

computed() { "$BUILD/tests/verification" >"$OLDPWD/page.md"; }
check "every row of the verification is within its tolerance" computed
# The last digits of an adaptive solver depend on the machine's mathematics library: of those rows the page
# contains the verdict only.
comparable() { sed -E 's/^(\|[^|]*(against|of) (erk|adams) \|[^|]*\|)[^|]*/\1 /' "$1"; }
same_page() {
    comparable docs/verification.md >"$OLDPWD/shown"
    comparable "$OLDPWD/page.md" >"$OLDPWD/now"
    diff "$OLDPWD/shown" "$OLDPWD/now"
}
check "docs/verification.md is up to date (scripts/write-verification writes it)" same_page
some() { [ "$(grep -c ' ok |$' docs/verification.md)" -gt 200 ]; }
check "the page has its rows" some
finish
