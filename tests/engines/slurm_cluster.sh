#!/bin/sh
# SPDX-License-Identifier: MIT
# Runs a command on a Slurm cluster of its own: munged, slurmctld and slurmd on the loopback, with
# key, configuration and state in a new folder, which is removed afterwards with the three daemons.
# Needs slurm-wlm and munge, as any user; an installed configuration is neither read nor changed. Exit
# status 77 if they are not there, 1 if the cluster does not come up, or else the command's.
# Usage: slurm_cluster.sh COMMAND [ARGUMENT...]
set -eu
PATH=$PATH:/usr/sbin:/sbin
for program in munged slurmctld slurmd sbatch squeue scancel sinfo; do
  command -v "$program" >/dev/null || { echo "no $program here: Slurm was not tried"; exit 77; }
done

folder=$(mktemp -d)
daemons=''
state=none
stop() {
  # A task is no child of slurmd: end what is left of them as long as somebody can.
  if [ "$state" = idle ]; then
    scancel --user="$(id -un)" || true
    for _ in $(seq 100); do
      [ -n "$(squeue --noheader)" ] || break
      sleep 0.1
    done
  fi
  # The newest first: slurmd asks slurmctld, and both ask munged.
  for daemon in $daemons; do
    kill "$daemon" 2>/dev/null || true
    wait "$daemon" || true
  done
  rm -rf "$folder"
}
trap stop EXIT
trap 'exit 130' INT TERM
chmod 755 "$folder"
mkdir "$folder/state" "$folder/spool"
head -c 1024 /dev/urandom >"$folder/key"
chmod 600 "$folder/key"

host=$(uname -n | cut -d . -f 1)
port=$((20000 + $$ % 20000))
cat >"$folder/slurm.conf" <<END_OF_CONFIGURATION
ClusterName=loopback
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/munge
AuthInfo=socket=$folder/munge
CredType=cred/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
ReturnToService=2
KillWait=1
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=0,sched_min_interval=0,sched_interval=1
SlurmdParameters=config_overrides
NodeName=loopback NodeHostname=$host NodeAddr=127.0.0.1 CPUs=8 RealMemory=1000000
PartitionName=all Nodes=loopback Default=YES MaxTime=INFINITE State=UP
END_OF_CONFIGURATION
export SLURM_CONF="$folder/slurm.conf"

munged --foreground --force --key-file="$folder/key" --socket="$folder/munge" --pid-file="$folder/munged.pid" \
  --seed-file="$folder/seed" --log-file="$folder/munged.log" >"$folder/munged.out" 2>&1 &
daemons=$!
for _ in $(seq 100); do
  [ -S "$folder/munge" ] && break
  sleep 0.1
done
slurmctld -D -i -f "$SLURM_CONF" >"$folder/slurmctld.out" 2>&1 &
daemons="$! $daemons"
slurmd -D -N loopback -f "$SLURM_CONF" >"$folder/slurmd.out" 2>&1 &
daemons="$! $daemons"
for _ in $(seq 300); do
  state=$(sinfo --noheader --format=%t 2>/dev/null) || true
  [ "$state" = idle ] && break
  sleep 0.1
done
if [ "$state" != idle ]; then
  echo "the cluster did not come up, its node is '$state'"
  tail -n 20 "$folder"/*.out "$folder"/*.log
  exit 1
fi

status=0
"$@" || status=$?
exit "$status"
