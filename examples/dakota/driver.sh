#!/bin/sh
# The analysis driver of dakota.in: Dakota calls it with the names of its two files.
problem=${PROBLEM:-$(dirname "$0")/../../problems/length-or-force.yaml}
exec crushzone dakota "$1" "$2" --problem "$problem" --jobs 1 -q
