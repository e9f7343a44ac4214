# The Snakefile, by the commands of docs/clusters.md.
. "$SOURCE/tests/support/cases.sh"
. "$SOURCE/tests/support/pages.sh"
. "$SOURCE/tests/cli/cli.sh"
PATH=$BUILD:$PATH
export PATH
if ! command -v snakemake >/dev/null 2>&1; then
    skipped "the Snakefile merges shards to the bytes of one run" "no snakemake; packages.txt, [cluster]"
    check "the Snakefile is there" test -s "$SOURCE/examples/cluster/Snakefile"
    finish
fi
mkdir root
n=$(commands_of "$SOURCE/docs/clusters.md" "sh snakemake")
"$SOURCE/scripts/link-project" root
cd root || exit 1
for i in $(seq "$n"); do
    [ "$i" != "$n" ] || touch ../before
    check "clusters.md: $(cat "../command.$i")" run_as_shown "$i"
done
only_one() { [ "$(find part-* -name shard.jsonl -newer ../before)" = part-5/shard.jsonl ] && [ all/sample.json -nt ../before ]; }
check "only the shard that was missing is run again" only_one
whole() { exits 1 crushzone sample scatter.yaml -q -o whole && same_results whole all; }
check "its shards merge to the bytes of one run" whole
finish
