#!/bin/sh
# Submits the job array of sample-array.sbatch, and the job that merges its shards: submit-samples.sh scatter.yaml
#
# The merge begins when all tasks have ended (afterany), also where one was killed, because it names the shards to run again.
set -eu
here=$(dirname "$0")
array=$(sbatch --parsable "$here/sample-array.sbatch" "$1")
merge=$(sbatch --parsable --dependency="afterany:$array" "$here/merge.sbatch")
echo "samples: job array $array; merge: job $merge, results in all/"
