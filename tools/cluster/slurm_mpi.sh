#!/bin/sh
# slurm_mpi.sh - a picture on the nodes of one job of Slurm, by rtc-mpi.
#
#   sbatch --nodes=8 slurm_mpi.sh SCENE.rts OUT.exr [OPTION of rtc]...
#
# One rank on each node, with all of its cores: a node then has one film, one scene and one photon
# map. OUT.rtpart is the checkpoint, on a file system that the first node sees. When time runs out
# the job is queued again and goes on; the same command goes on, too, on any number of nodes. Adapt
# the lines below to the cluster; RTC_MPI names the program.
#SBATCH --job-name=rtc-mpi
#SBATCH --ntasks-per-node=1
#SBATCH --exclusive
#SBATCH --time=12:00:00
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --signal=TERM@120
set -eu
scene=$1 out=$2
shift 2
film=$out.rtpart
if [ -f "$film" ]; then
    set -- --resume "$film" "$@"
else
    set -- "$scene" --checkpoint "$film" --every 300 --out "$out" "$@"
fi
status=0
srun "${RTC_MPI:-rtc-mpi}" "$@" || status=$?
[ "$status" -ne 130 ] || scontrol requeue "$SLURM_JOB_ID"
exit "$status"
