#!/bin/sh
# RUN: design_loop.sh problems/two-cars-25kmh.yaml
# A design loop in shell: the speed at which two cars still collide without more than 1500 kN, by bisection.
#
#   design_loop.sh PROBLEM.yaml
#
# Each pass of the loop is one run of the program with another value, and reads one number of its JSON.
set -eu
problem=${1:?name a problem file}
limit_kN=1500
low=0 # km/h, known to pass
high=40

peak_force_kN() { # peak_force_kN SPEED: largest interface force of the run
    crushzone run "$problem" --json --set "trains.A.speed_km_h=$1" |
        sed -n 's/.*"peak_force_kN": *\([0-9.eE+-]*\).*/\1/p' | sort -g | tail -n 1
}

while [ $((high - low)) -gt 1 ]; do
    speed=$(((low + high) / 2))
    force=$(peak_force_kN $speed)
    echo "$speed km/h: $force kN"
    if [ "$(echo "$force $limit_kN" | awk '{ print ($1 <= $2) }')" = 1 ]; then low=$speed; else high=$speed; fi
done
echo "up to $low km/h the interface force stays below $limit_kN kN"
