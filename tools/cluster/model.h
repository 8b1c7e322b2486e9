/*
 * model.h - how long a picture takes on so many ranks, processes of one thread each: a simulator of
 * discrete events. README.md says what the model is, figures.txt what it was measured and assumed
 * with.
 */
#ifndef RT_TOOLS_CLUSTER_MODEL_H
#define RT_TOOLS_CLUSTER_MODEL_H

/* The parameters: X(name, default, what). All are numbers; seconds, bytes or counts. */
#define MODEL_PARAMETERS(X)                                                                        \
    /* the picture */                                                                              \
    X(width, 1920, "pixels")                                                                       \
    X(height, 1080, "pixels")                                                                      \
    X(spp, 1024, "samples of a pixel, in all passes together")                                     \
    X(planes, 1, "of sums: 1, or 8 where the error is estimated; and one for each layer")          \
    X(photons, 1e8, "photon paths, in all passes together")                                        \
    /* measured: see measure.c */                                                                  \
    X(start, 0.5, "s, until a process has its first chunk")                                        \
    X(sample, 2e-6, "s, one sample of one pixel by one thread")                                    \
    X(chunk, 0, "s, what a chunk costs beside its samples")                                        \
    X(spread, 0.4, "standard deviation of a chunk's time over its mean")                           \
    X(crowding, 1, "by how much a thread is slower where all `cores` work")                        \
    X(pixel_bytes, 64, "bytes, a pixel of a film on its way")                                      \
    X(encode, 1e-7, "s, a pixel")                                                                  \
    X(decode, 1e-7, "s, a pixel")                                                                  \
    X(add, 1e-8, "s, a pixel")                                                                     \
    X(resolve, 1e-7, "s, a pixel")                                                                 \
    X(path, 1e-6, "s, one photon path")                                                            \
    X(stored, 1, "photons that a path leaves")                                                     \
    X(gather, 5e-6, "s, one sample with its gathering")                                            \
    X(tree, 5e-7, "s, a photon, of building the tree")                                             \
    /* assumed */                                                                                  \
    X(ranks, 1, "processes of one thread")                                                         \
    X(cores, 0, "that they share; 0: one each")                                                    \
    X(bandwidth, 1.25e9, "bytes/s into one rank")                                                  \
    X(latency, 5e-5, "s, of a message")                                                            \
    X(serve, 1e-5, "s, in which rank 0 answers a request")                                         \
    X(photon_bytes, 64, "bytes, a photon of a map on its way")                                     \
    X(query_bytes, 112, "bytes, a query of another rank's photons and its answer")                 \
    X(slices, 8, "of a map that is divided, each on a rank of its own")                            \
    X(speeds, 0.05, "standard deviation of the ranks' speeds")                                     \
    X(stragglers, 0.01, "fraction of ranks that are slow")                                         \
    X(straggling, 3, "how much slower these are")                                                  \
    X(life, 3e7, "s, mean time to a failure of a rank; 0: there are none")                         \
    X(relaunch, 60, "s, until a failed run, or part, begins again")                                \
    X(every, 300, "s, between checkpoints")                                                        \
    X(taking, 0.1, "of its time at most rank 0 receives films, before the end")                    \
    X(late, 10, "times `every`: a film is not kept back for that any longer")                      \
    /* what the schedule does */                                                                   \
    X(tasks, 64, "for each rank, of equal size")                                                   \
    X(guided, 2, "a task is at most 1/(guided ranks) of what is left; 0: no limit")                \
    X(largest_first, 0, "1: the last chunks, which have the most samples, are the first task")     \
    X(pieces, 16, "parts for each rank, of which it takes one after the other")                    \
    X(passes, 0, "progressive passes")                                                             \
    X(seed, 1, "of the simulator")                                                                 \
    X(repeats, 3, "simulations, of which the mean is taken")

/* Who renders which chunk. */
typedef enum schedule { BY_DEMAND, IN_PARTS } schedule;

/*
 * How films come together: all to rank 0, by a tree of pairs, or to rank 0 from ranks that keep to
 * bands.
 */
typedef enum reduction { DIRECT, TREE, BANDS } reduction;

/*
 * Whose photons are gathered: none; each rank's own whole map, emitted anew; one that is emitted in
 * parts and then exchanged; one whose parts stay where they are; or those of each pass.
 */
typedef enum photon_plan { NO_PHOTONS, EMITTED_BY_EACH, EXCHANGED, DIVIDED, IN_PASSES } photon_plan;

typedef struct model {
#define MEMBER(name, value, what) double name;
    MODEL_PARAMETERS(MEMBER)
#undef MEMBER
    schedule schedule;
    reduction reduction;
    photon_plan photon_plan;
} model;

/* Seconds until the film is resolved, mean of all repeats; negative: out of memory. */
double model_seconds(const model *m);

#endif
