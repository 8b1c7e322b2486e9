#!/bin/sh
# slurm_array.sh - a picture in parts on Slurm: an array of jobs, and one that merges their films.
#
#   sh slurm_array.sh SCENE.rts OUT.exr PARTS [OPTION of rtc]...
#
# It submits both and ends. OUT.parts/ receives the films, which all nodes must see; each is its
# task's checkpoint at the same time. A task that is stopped early, as by its time limit or by
# preemption, is queued again and goes on. The same command, later, makes what is missing and
# merges again. Adapt the lines below to the cluster; RTC names the program.
#SBATCH --job-name=rtc
#SBATCH --cpus-per-task=16
#SBATCH --mem=8G
#SBATCH --time=12:00:00
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --signal=TERM@120
set -eu
rtc=${RTC:-rtc}

# One task of the array. Its number is given, as --part auto would count a task that is submitted
# again, alone, as the only one.
render() {
    film=$1.parts/$SLURM_ARRAY_TASK_ID.rtpart
    scene=$2
    parts=$3
    shift 3
    if [ -f "$film" ]; then
        set -- --resume "$film" "$@"
    else
        set -- "$scene" --part "$SLURM_ARRAY_TASK_ID/$parts" --checkpoint "$film" --every 300 \
            --out "$film" "$@"
    fi
    status=0
    srun "$rtc" "$@" --threads "${SLURM_CPUS_PER_TASK:-1}" || status=$?
    [ "$status" -ne 130 ] || scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID"
    exit "$status"
}

case ${1:-} in
--render)
    shift
    render "$@"
    ;;
--merge)
    exec srun "$rtc" merge "$2.parts"/*.rtpart --out "$2"
    ;;
*)
    scene=$1 out=$2 parts=$3
    shift 3
    mkdir -p "$out.parts"
    job=$(sbatch --parsable --array="1-$parts" "$0" --render "$out" "$scene" "$parts" "$@")
    sbatch --dependency="afterok:${job%%;*}" --cpus-per-task=1 "$0" --merge "$out"
    ;;
esac
