# docs/track.md has the differences as computed now; costs depend on the machine.
. "$SOURCE/tests/support/cases.sh"
cd "$SOURCE"

computed() { "$BUILD/tests/tracks" >"$OLDPWD/page.md"; }
check "shipped problems run on every track" computed
same_page() {
    sed 's/^\(| cost of [^|]*|\).*/\1/' docs/track.md >"$OLDPWD/shown"
    sed 's/^\(| cost of [^|]*|\).*/\1/' "$OLDPWD/page.md" >"$OLDPWD/now"
    diff "$OLDPWD/shown" "$OLDPWD/now"
}
check "docs/track.md is up to date (scripts/write-track writes it)" same_page
# The order of the costs is rigid < receptance < modal < fe in every measured row.
ordered() {
    awk -F'|' '/^\| cost of /{ n++; if (!(1 < $4 + 0 && $4 + 0 < $5 + 0) || ($6 + 0 > 0 && $5 + 0 >= $6 + 0)) exit 1 }
               END { exit n < 3 }' docs/track.md
}
check "its costs are in the order of the models" ordered
finish
