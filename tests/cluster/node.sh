# A cluster of this one machine for a test: Debian's munged, slurmctld and slurmd, as root, on the loopback address. Keys,
# settings and state are in a folder of the test's own, and what was started is ended by its process id when the test ends.
# Source it after support/cases.sh.
#
#   cluster_missing          prints why there can be none; nothing where it can
#   cluster_start FOLDER     starts it, with SLURM_CONF for sbatch, scancel and so on
#   cluster_wait [JOB]       waits until no job, or not this one, is queued or running

cluster_missing() {
    if [ "$(id -u)" != 0 ]; then
        echo "only root can start it"
        return
    fi
    for command in munged slurmctld slurmd sbatch; do
        command -v $command >/dev/null 2>&1 || { echo "no $command; packages.txt, [cluster]"; return; }
    done
}

# Two ports that nobody listens at.
free_ports() {
    listening=$(awk 'NR > 1 { n = split($2, part, ":"); print part[n] }' /proc/net/tcp /proc/net/tcp6 2>/dev/null)
    n=0
    port=$((20000 + $$ % 10000))
    while [ $n -lt 2 ]; do
        port=$((port + 1))
        echo "$listening" | grep -qix "$(printf %04X $port)" && continue
        echo $port
        n=$((n + 1))
    done
}

write_settings() { # write_settings PORT PORT
    cat >"$SLURM_CONF" <<END
ClusterName=one
SlurmctldHost=$(hostname)(127.0.0.1)
SlurmctldPort=$1
SlurmdPort=$2
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket=$cluster/munge.socket
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
MailProg=/bin/true
StateSaveLocation=$cluster/state
SlurmdSpoolDir=$cluster/spool
SlurmctldPidFile=$cluster/slurmctld.pid
SlurmdPidFile=$cluster/slurmd.pid
SlurmUser=root
KillWait=2
ReturnToService=2
SchedulerParameters=batch_sched_delay=0,sched_interval=1,sched_min_interval=0,bf_interval=1
NodeName=$(hostname) NodeAddr=127.0.0.1 CPUs=$(getconf _NPROCESSORS_ONLN) RealMemory=256 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
}

start() { # start COMMAND...: in the background, its process in $started
    "$@" >"$cluster/$1.out" 2>&1 </dev/null &
    daemons="$! $daemons"
}

cluster_start() {
    cluster=$1
    daemons=
    mkdir -p "$cluster/state" "$cluster/spool"
    chmod 755 "$cluster" # the socket's folder, which munged demands
    (umask 077 && head -c 128 /dev/urandom >"$cluster/munge.key")
    export SLURM_CONF="$cluster/slurm.conf"
    # shellcheck disable=SC2046 # two words
    write_settings $(free_ports)
    trap 'cluster_stop; rm -f "$cases_output"' EXIT
    trap 'exit 130' HUP INT TERM
    start munged --foreground --key-file="$cluster/munge.key" --socket="$cluster/munge.socket" \
        --pid-file="$cluster/munged.pid" --log-file="$cluster/munged.log" --seed-file="$cluster/munged.seed"
    start slurmctld -D
    start slurmd -D
    for try in $(seq 300); do
        [ "$(sinfo -h -o %T 2>/dev/null)" = idle ] && return
        sleep 0.1
    done
    echo "no idle node after 30 s:"
    tail -n 5 "$cluster"/*.out
    return 1
}

# Jobs first, because their processes are not those of the daemons.
cluster_stop() {
    timeout 5 scancel -u root 2>/dev/null
    for try in $(seq 50); do
        [ -n "$(timeout 5 squeue -h 2>/dev/null)" ] || break
        sleep 0.1
    done
    # shellcheck disable=SC2086 # process ids
    kill $daemons 2>/dev/null
    # shellcheck disable=SC2086
    wait $daemons 2>/dev/null
}

cluster_wait() { # for two minutes at most
    for try in $(seq 600); do
        [ -n "$(squeue -h ${1:+-j "$1"} 2>/dev/null)" ] || return 0
        sleep 0.2
    done
    squeue
    return 1
}
