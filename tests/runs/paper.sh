# The published example: the five numbers, on the elastic track and the rigid one; other sets; the fit.
. "$SOURCE/tests/support/cases.sh"
paper=$SOURCE/problems/paper-25kmh.yaml

# The verdict is over the five numbers with their tolerances and the travel of a bogie at its link.
holds() { "$PROGRAM" check "$paper" --quiet -o out "$@"; }
value() { sed -n "/\"name\": \"$1\"/,/\"value\"/s/.*\"value\": \([-0-9.e]*\).*/\1/p" out/summary.json | head -1; }
within() { # within NAME TARGET TOLERANCE
    awk -v v="$(value "$1")" -v t="$2" -v w="$3" 'BEGIN { exit !(v != "" && v - t <= w && t - v <= w) }'
}

check "the five published numbers are within tolerance on the elastic track" holds
check "the track is the elastic one" grep -q '"track": "modal"' out/summary.json
check "the anti-climbers touch at 50 ms +- 2 ms" within "anti-climbers touch" 50 2
check "the coupler shears off at 911 kN +- 1 %" within "shear-off force" 911 9.11
check "the 300 mm of the anti-climber are exhausted" within "share of the anti-climber's 300 mm" 1 0.01
check "the interface carries 4500 kN +- 5 %" within "peak interface force" 4500 225
check "the body moves back at 9 km/h +- 0.5 km/h at 150 ms" within "speed of the body at 150 ms" -2.5 0.139
check "the energy balance is below 1e-4" \
    awk -v v="$(sed -n 's/.*"balance_error": \([-0-9.e]*\).*/\1/p' out/summary.json | head -1)" 'BEGIN { exit !(v < 1e-4) }'
check "they are within tolerance on the rigid track" holds --set simulation.track=rigid
# Mass, frame, link, guidance, tube's stroke and force, gap, anti-climber, three forces of the end, two stiffnesses of its
# unloading, end mass, brake.
holds_for() {
    holds --set "parts.paper-car.mass_t=$1" --set "parts.paper-bogie.mass_kg=$2" \
        --set "parts.paper-bogie.link.stiffness_MN_m=$3" --set "parts.paper-bogie.guidance_stiffness_MN_m=$4" \
        --set "parts.paper-tube.stages[0].stroke_mm=$5" --set "parts.paper-tube.stages[0].force_kN=$6" \
        --set "parts.paper-anti-climber.gap_mm=$7" --set "parts.paper-anti-climber.stages[0].force_kN=$8" \
        --set "parts.paper-end.stages[0].force_kN=$9" --set "parts.paper-end.stages[1].force_kN=${10}" \
        --set "parts.paper-end.stages[2].force_kN=${11}" --set "parts.paper-end.unloading_stiffness_MN_m=${12}" \
        --set "parts.paper-end.second_unloading_stiffness_MN_m=${13}" --set "parts.paper-end.mass_t=${14}" \
        --set "trains.A.brake.ratio=${15}" --set "trains.B.brake.ratio=${15}"
}
check "they are within tolerance for the second set of the documentation" \
    holds_for 29.32 3614 19.07 22.35 57.3 474.3 331.9 886.6 4246 7413 6000 236 41.92 0.92 0.16
check "they are within tolerance for the third set" holds_for 28.75 3785 17.92 34.7 47.4 489 335.2 887 4316 7253 6360 230.3 39.5 0.985 0.149
check "they are within tolerance for the fourth set" holds_for 28 3485 18.51 53.4 20 441 337.4 878 3895 6734 4894 207.7 59.8 1.44 0.143
check "a heavy car is outside the tolerances" sh -c "! '$PROGRAM' check '$paper' --quiet -o out --set parts.paper-car.mass_t=38"

check "a short fit from the file's start ends within every tolerance" \
    "$PROGRAM" optimise "$SOURCE/problems/paper-25kmh-identify.yaml" --evaluations 400 --quiet -o found
nothing "none of its parameters is at a bound" grep '"at_bound": true' found/outcome.json
check "the fitted values are written as a file within the tolerances" "$PROGRAM" check found/optimised.yaml --quiet -o again
check "two trains of such cars meet the end criterion" \
    "$PROGRAM" run "$SOURCE/problems/paper-trains-25kmh.yaml" --quiet -o trains
finish
