# The report in a real browser: Debian's chromium, driven by playwright-core from npm. Missing packages are reported.
. "$SOURCE/tests/support/cases.sh"

folders="metro pair rigid search long"
pages="swept map sampled compared"
several="several"

# Counts every case of report.js as skipped.
skip_all() { # skip_all REASON
    sed -n 's/.*await check(`${\([a-z]*\)}: \([^`]*\)`.*/\1 \2/p' "$SOURCE/tests/browser/report.js" >sentences
    for what in $folders $pages $several; do
        kind=folder
        case " $pages " in *" $what "*) kind=name ;; esac
        case " $several " in *" $what "*) kind=set ;; esac
        sed -n "s/^$kind //p" sentences | while IFS= read -r sentence; do skipped "$what: $sentence" "$1"; done
    done
    finish
}

for command in chromium node npm; do
    command -v $command >/dev/null 2>&1 ||
        skip_all "there is no command $command; packages.txt names the package under [browser]"
done
[ "$(node -p 'process.versions.node.split(".")[0]')" -ge 18 ] ||
    skip_all "playwright-core needs Node.js 18, but this is $(node --version)"

# playwright-core is fetched once per build folder and version.
modules=$BUILD/tests/browser-modules
mkdir -p "$modules"
if ! cmp -s "$SOURCE/tests/browser/package-lock.json" "$modules/package-lock.json" ||
    ! [ -d "$modules/node_modules/playwright-core" ]; then
    cp "$SOURCE/tests/browser/package.json" "$SOURCE/tests/browser/package-lock.json" "$modules/"
    if ! (cd "$modules" && npm ci --no-audit --no-fund) >npm.log 2>&1; then
        rm -rf "$modules"
        cat npm.log
        skip_all "npm cannot fetch playwright-core; see build/release-tests.log"
    fi
fi

# A collision of full cars, one of rigid ones, a search, and trains of eight full cars, whose report is the largest.
long_metro() {
    ln -s "$SOURCE/problems/catalogue" "$SOURCE/problems/profiles" .
    sed -e 's/^\( *\)- {name: A3, use: metro-third-car, reversed: true}/&\n\1- {name: M1, use: metro-third-car, reversed: true}\n\1- {name: M2, use: metro-third-car}/' \
        -e '/^optimise:/,$d' "$SOURCE/problems/metro-6-car.yaml" >long.yaml
    "$PROGRAM" run long.yaml --scenario 25-km-h -o long
}
check "crushzone runs a metro" "$PROGRAM" run "$SOURCE/problems/metro-6-car.yaml" --scenario 25-km-h -o metro
check "crushzone runs two cars" "$PROGRAM" run "$SOURCE/problems/two-cars-25kmh.yaml" -o pair
check "crushzone runs rigid cars" sh -c '"$PROGRAM" new two-trains && "$PROGRAM" run two-trains.yaml -o rigid'
check "crushzone optimises" sh -c '"$PROGRAM" optimise two-trains.yaml --evaluations 60 -o search; [ $? -le 1 ]'
check "crushzone runs trains of eight cars" long_metro
swept() { "$PROGRAM" sweep "$SOURCE/problems/two-cars-25kmh.yaml" --vary trains.A.speed_km_h=10:50:9 -o swept && mv swept/report.html swept.html; }
map() { "$PROGRAM" sweep two-trains.yaml --vary trains.A.speed_km_h=10:40:13 --vary 'parts.inner-end.coupler.tube.stages[0].force_kN=500:1200:8' -o map && mv map/report.html map.html; }
sampled() { sed 's/^extends: .*/extends: two-trains.yaml/' "$SOURCE/examples/scatter.yaml" >scatter.yaml && { "$PROGRAM" sample scatter.yaml -n 100 -o sampled || [ $? = 1 ]; } && mv sampled/report.html sampled.html; }
compared() { "$PROGRAM" compare rigid search/optimised.yaml -o compared.html; }
scenarios() {
    printf 'extends: two-trains.yaml\ndocument: {project: Line 8, author: J. Doe, revision: B, date: 2026-11-30}\nscenarios: [{name: slow, speed_km_h: 10}, {name: usual}, {name: fast, speed_km_h: 30}, {name: low, height_offset_mm: -40}, {name: high, height_offset_mm: 40}]\nchecks: {profile: en15227-2008, category: C-II, design_rules: true}\n' >several.yaml
    "$PROGRAM" run several.yaml -o several.set
}
check "crushzone runs several scenarios" scenarios
check "crushzone sweeps the speed" swept
check "crushzone maps two values" map
check "crushzone draws samples" sampled
check "crushzone compares two designs" compared

CHROMIUM=$(command -v chromium) NODE_PATH=$modules/node_modules node "$SOURCE/tests/browser/report.js" $folders $(printf '%s.html ' $pages) $(printf '%s.set ' $several) >cases.txt 2>&1
code=$?
cat cases.txt
n_passed=$((n_passed + $(grep -c '^ok - ' cases.txt)))
n_failed=$((n_failed + $(grep -c '^not ok - ' cases.txt)))
[ $code = 0 ] || [ "$(grep -c '^not ok - ' cases.txt)" -gt 0 ] || check "the browser tests end" false
finish
