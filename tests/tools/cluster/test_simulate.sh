#!/bin/sh
# test_simulate.sh - the simulator of clusters agrees with what can be computed by hand. Needs
# build/tools/cluster/simulate.
set -u
simulate=$PWD/build/tools/cluster/simulate
. "${0%/*}/check.sh"

# A cluster without chance, of one megapixel and 1024 samples of 1 us: 1074 s of work.
calm="width=1024 height=1024 spp=1024 sample=1e-6 start=1 spread=0 speeds=0 stragglers=0 life=0
    encode=0 decode=0 add=0 resolve=0 latency=0 serve=0 bandwidth=1e9 path=1e-6 stored=1 tree=0
    gather=1e-6 every=1e9"
# seconds NAME=VALUE...: of that cluster.
# shellcheck disable=SC2086 # a list
seconds() { "$simulate" $calm "$@" | cut -d' ' -f1; }
# is EXPECTED TOLERANCE NAME=VALUE...: the seconds are within this part of what is expected.
is() {
    expected=$1 tolerance=$2
    shift 2
    got=$(seconds "$@")
    echo "$got s, and not $expected s: $*"
    awk -v got="$got" -v want="$expected" -v tolerance="$tolerance" \
        'BEGIN { exit !(got > want * (1 - tolerance) && got < want * (1 + tolerance)) }'
}

check one_rank_takes_start_and_samples is 1074.74 1e-3 ranks=1
check ranks_share_the_samples is 11.74 0.02 ranks=100 pixel_bytes=0
check ranks_share_the_cores is 540 0.02 ranks=4 cores=2 pixel_bytes=0
check parts_share_the_samples is 11.74 0.02 ranks=100 pixel_bytes=0 schedule=parts pieces=1
check a_straggler_takes_little_by_demand is 12.1 0.03 ranks=100 pixel_bytes=0 \
    stragglers=0.02 straggling=3 repeats=50
# Films of 67 MB, which take 67 ms each; in bands, 256 ranks return 0.8 MB at most.
check rank_0_receives_films_one_by_one is 7.71 0.02 ranks=100 spp=65536 sample=1e-10
check a_tree_receives_them_in_log_time is 1.54 0.02 ranks=100 spp=65536 sample=1e-10 films=tree
check bands_make_films_small is 1.23 0.02 ranks=256 spp=65536 sample=1e-10 films=bands
check each_rank_emits_all_photons is 111.74 0.02 ranks=100 pixel_bytes=0 map=each photons=1e8
check photons_are_emitted_in_parts_and_exchanged is 62.74 0.02 ranks=100 pixel_bytes=0 \
    map=exchanged photons=1e8 photon_bytes=62.5
# The first radii and one pass, of 1.05 s each.
check passes_are_shared_no_further is 3.1 0.01 ranks=2000 pixel_bytes=0 map=passes passes=1000 \
    spp=1000 photons=0
# Every 100 s one of 100 ranks fails and undoes half of 20 s, in 11 s of work or so.
check failures_undo_the_work_since_a_checkpoint is 1330 0.03 ranks=100 sample=1e-5 spp=10240 \
    pixel_bytes=0 life=10000 every=20 relaunch=10 repeats=100

# A film takes 1.05 s. It is due every 60 s, but rank 0 asks for one in ten seconds, and for all of
# them after 600 s. Those that are late come in by 7 steps, as all do at the end.
films="ranks=100 spp=102400 sample=1e-6 tasks=640 pixel_bytes=1000 films=tree"
# shellcheck disable=SC2086 # a list
check films_take_rank_0_a_tenth_of_its_time is 1090 4e-3 $films every=60
# shellcheck disable=SC2086 # a list
check films_come_in_by_a_tree_at_the_end is 1082.1 1e-3 $films

check unknown_parameters_are_refused eval '! "$simulate" rank=3'
check words_are_no_numbers eval '! "$simulate" ranks=many'
exit $bad
