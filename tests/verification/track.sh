# docs/track.md has the differences that are computed now; what a track costs is the machine's own.
. "$SOURCE/tests/support/cases.sh"
cd "$SOURCE"

computed() { "$BUILD/tests/tracks" >"$OLDPWD/page.md"; }
check "shipped problems run on every track" computed
same_page() {
    sed 's/^\(| cost of [^|]*|\).*/\1/' docs/track.md >"$OLDPWD/shown"
    sed 's/^\(| cost of [^|]*|\).*/\1/' "$OLDPWD/page.md" >"$OLDPWD/now"
    diff "$OLDPWD/shown" "$OLDPWD/now"
}
check "docs/track.md is what is computed now (scripts/write-track writes it)" same_page
# A dearer model must be worth it, and a cheap one cheap: rigid < co-running < modal < fe, in every row that was measured.
ordered() {
    awk -F'|' '/^\| cost of /{ n++; if (!(1 < $4 + 0 && $4 + 0 < $5 + 0) || ($6 + 0 > 0 && $5 + 0 >= $6 + 0)) exit 1 }
               END { exit n < 3 }' docs/track.md
}
check "its costs are in the order of the models" ordered
finish
