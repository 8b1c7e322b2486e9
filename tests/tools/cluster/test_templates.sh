#!/bin/sh
# test_templates.sh - the templates for Slurm and Kubernetes, run without them: what they submit
# renders a picture in parts with the bytes of a single render, and goes on where a part was
# interrupted. Needs build/rtc.
#
# In their place are programs that set the variables which these engines set, and run the jobs one
# after the other.
set -u
rtc=$PWD/build/rtc
templates=$PWD/tools/cluster
. "${0%/*}/check.sh"
cd "$work" || exit 1
mkdir bin
PATH=$work/bin:$PATH
export PATH work

program() { cat >"bin/$1" && chmod +x "bin/$1"; }

# ---- In place of the engines -----------------------------------------------------------------

program sbatch <<'END_OF_PROGRAM'
#!/bin/sh
echo "sbatch $*" >>"$work/calls"
first=0
last=0
while :; do
    case $1 in
    --array=*) range=${1#*=} first=${range%-*} last=${range#*-} ;;
    --cpus-per-task=*) export SLURM_CPUS_PER_TASK="${1#*=}" ;;
    --*) ;;
    *) break ;;
    esac
    shift
done
export SLURM_JOB_ID=70 SLURM_PROCID=0 SLURM_NTASKS=1
for i in $(seq "$first" "$last"); do
    [ "$i" -eq 0 ] || export SLURM_ARRAY_JOB_ID=70 SLURM_ARRAY_TASK_ID="$i" \
        SLURM_ARRAY_TASK_MIN="$first" SLURM_ARRAY_TASK_COUNT="$((last - first + 1))"
    while sh "$@" >>"$work/jobs.log" 2>&1; [ -f "$work/again" ]; do rm "$work/again"; done
done
echo '70;cluster'
END_OF_PROGRAM
program srun <<'END_OF_PROGRAM'
#!/bin/sh
exec "$@"
END_OF_PROGRAM
program scontrol <<'END_OF_PROGRAM'
#!/bin/sh
echo "scontrol $*" >>"$work/calls"
: >"$work/again"
END_OF_PROGRAM
# rtc, whose first render of the second part ends early, as by SIGTERM, with the film so far.
program rtc <<END_OF_PROGRAM
#!/bin/sh
case "\$*" in
*'--part 2/3'* | *'--part auto'*/1.rtpart* | *'--checkpoint out.pfm.rtpart'*)
    if [ ! -f "\$work/interrupted" ]; then
        : >"\$work/interrupted"
        '$rtc' "\$@" --quiet --time 1e-6 || exit
        exit 130
    fi
    ;;
*--resume*) set -- "\$@" --time 1e9 ;;
esac
exec '$rtc' "\$@" --quiet
END_OF_PROGRAM
ln -s rtc bin/rtc-mpi

cat >scene.rts <<'END_OF_SCENE'
camera { eye 0 1 -4  look_at 0 1 0  fov 40 }
film { width 120  height 70 }
material white { kd 0.7 }
plane { point 0 0 0  normal 0 1 0  material white }
sphere { centre 0 1 0  radius 1  material white }
light point { position 2 4 -3  intensity 20 }
END_OF_SCENE
"$rtc" scene.rts --spp 40 --quiet --out whole.pfm || exit 1

same() { cat jobs.log; cmp whole.pfm "$1"; }
fresh() { rm -rf out* calls jobs.log interrupted; : >calls; : >jobs.log; }

# ---- Slurm -----------------------------------------------------------------------------------

array() { sh "$templates/slurm_array.sh" scene.rts out.pfm 3 --spp 40; }
fresh
check slurm_array_is_submitted array
check slurm_array_makes_the_picture same out.pfm
check slurm_array_queues_again_what_was_interrupted grep -qx 'scontrol requeue 70_2' calls
check slurm_merge_waits_for_the_parts grep -q 'sbatch --dependency=afterok:70 ' calls
rm out.pfm out.pfm.parts/3.rtpart
check slurm_array_makes_what_is_missing array
check slurm_array_makes_the_picture_again same out.pfm

mpi() { sbatch --nodes=2 "$templates/slurm_mpi.sh" scene.rts out.pfm --spp 40; }
fresh
check slurm_mpi_is_submitted mpi
check slurm_mpi_makes_the_picture same out.pfm
check slurm_mpi_queues_again_what_was_interrupted grep -qx 'scontrol requeue 70' calls

# ---- Kubernetes ------------------------------------------------------------------------------

# script FILE: the shell script of its container, the block after "- |".
script() { awk '/^ *- \|$/ { on = 1; next } on && /^          [a-z]/ { exit } on' "$1"; }
# value FILE NAME: of an environment variable of its container.
value() { awk -v name="$2" '$2 == "name:" && $3 == name { getline; print $2 }' "$1"; }

indexed_job() {
    parts=$(sed -n 's/^  completions: //p' "$templates/kubernetes.yaml")
    [ "$(value "$templates/kubernetes.yaml" JOB_COMPLETIONS)" = "\"$parts\"" ] || return 1
    script "$templates/kubernetes.yaml" | sed 's/--spp [0-9]*/--spp 40/' >part.sh
    for i in $(seq 0 $((parts - 1))); do
        # A pod that fails is made anew.
        until SCENE=scene.rts FILMS=out.parts JOB_COMPLETIONS=$parts JOB_COMPLETION_INDEX=$i \
            sh -eu part.sh; do
            [ -f interrupted ] || return 1
            mv interrupted interrupted.once
        done
    done
}
merge_job() {
    script "$templates/kubernetes_merge.yaml" >merge.sh
    FILMS=out.parts OUT=out.pfm sh -eu merge.sh
}
yaml() {
    python3 - "$templates"/*.yaml <<'END_OF_PROGRAM'
import sys, yaml
for path in sys.argv[1:]:
    job = yaml.safe_load(open(path))
    assert (job["apiVersion"], job["kind"]) == ("batch/v1", "Job"), path
    container, = job["spec"]["template"]["spec"]["containers"]
    volumes = {v["name"] for v in job["spec"]["template"]["spec"]["volumes"]}
    assert {m["name"] for m in container["volumeMounts"]} == volumes, path
    assert container["command"] == ["/bin/sh", "-euc"] and len(container["args"]) == 1, path
    assert all(isinstance(e["value"], str) for e in container["env"]), path
END_OF_PROGRAM
}
fresh
check kubernetes_parts_are_rendered indexed_job
check kubernetes_part_went_on_where_it_was_interrupted [ -f interrupted.once ]
check kubernetes_parts_are_merged merge_job
check kubernetes_makes_the_picture same out.pfm
if python3 -c 'import yaml' 2>/dev/null; then
    check kubernetes_jobs_are_valid yaml
else
    echo 'skip kubernetes_jobs_are_valid: python3 has no yaml'
fi
exit $bad
