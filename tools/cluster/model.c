/* model.c - the simulator: chunks on demand or in parts, films that come together, failures. */
#include "model.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { longest = 32, short_blocks = 12 };

/* A rank as it is simulated. */
typedef struct rank {
    double at;     /* when it asks for work next; at last, when it has finished */
    double speed;  /* of its thread, mean 1 */
    double saved;  /* when it handed its film over */
    double pixels; /* that its film has samples of */
} rank;

/* A simulation. */
typedef struct simulation {
    const model *m;
    rank *ranks;
    int count;
    uint64_t random;
    double busy;     /* rank 0 answers no request before; ranks ask one task ahead of films */
    double received; /* it receives no film before */
    double rested;   /* it asks for no film before */
} simulation;

/* ---- Random numbers -------------------------------------------------------------------------- */

/* Uniform in (0, 1): xorshift64*. */
static double uniform(uint64_t *state)
{
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    return ((double)(*state * 2685821657736338717ull >> 12) + 0.5) / 4503599627370496.0;
}

/* Positive, of mean 1 and this standard deviation: log-normal, by Box and Muller. */
static double around_one(uint64_t *state, double deviation)
{
    const double variance = log1p(deviation * deviation);
    const double radius = sqrt(-2 * log(uniform(state)));
    const double normal = radius * cos(6.283185307179586 * uniform(state));
    return exp(sqrt(variance) * normal - 0.5 * variance);
}

/* ---- Chunks ---------------------------------------------------------------------------------- */

static double pixels_of(const model *m)
{
    return m->width * m->height;
}

/* Pixels of a chunk: a 64th of the picture, but within limits. */
static double chunk_pixels(const model *m)
{
    return fmin(fmax(ceil(pixels_of(m) / 64), 64), 4096);
}

/* Chunks of one block of samples: bands of the picture. */
static double bands_of(const model *m)
{
    return ceil(pixels_of(m) / chunk_pixels(m));
}

/*
 * Samples of a pixel before a block. Blocks end at 1, 2, 3, 4, 6, 8, 12 ... 64 samples and from
 * there on every 32; in photon mode each has one sample.
 */
static double block_begin(const model *m, double block)
{
    static const int begins[] = {0, 1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48};
    if (m->photon_plan != NO_PHOTONS)
        return fmin(block, m->spp);
    return fmin(block < short_blocks ? begins[(int)block] : 64 + (block - short_blocks) * longest,
                m->spp);
}

/* Chunks of the picture; a pass is one. */
static double chunks_of(const model *m)
{
    double blocks = 0;
    if (m->photon_plan == IN_PASSES)
        return m->passes;
    while (block_begin(m, blocks) < m->spp)
        blocks++;
    return blocks * bands_of(m);
}

/* Samples in the chunks before this one. */
static double samples_before(const model *m, double chunk)
{
    const double bands = bands_of(m), block = floor(chunk / bands);
    const double begin = block_begin(m, block), end = block_begin(m, block + 1);
    if (m->photon_plan == IN_PASSES)
        return chunk / m->passes * m->spp * pixels_of(m);
    return (begin + (end - begin) * (chunk / bands - block)) * pixels_of(m);
}

/* Seconds of one thread for so many samples, in so many chunks, which lie in so many bands. */
static double work(simulation *s, double samples, double chunks, double bands)
{
    const model *m = s->m;
    const double apart = fmax(1 / bands - 1 / bands_of(m), 0);
    double each = m->photon_plan == NO_PHOTONS ? m->sample : m->gather;
    if (m->photon_plan == DIVIDED)
        each += (m->slices - 1) * m->query_bytes / m->bandwidth;
    if (m->photon_plan == IN_PASSES)
        return samples * each + chunks * m->photons / m->passes * (m->path + m->stored * m->tree);
    return samples * each * around_one(&s->random, m->spread * sqrt(apart)) + chunks * m->chunk;
}

/* Adds the pixels of so many chunks more to a rank's film. */
static void cover(const model *m, rank *r, double chunks, int count)
{
    const double all = pixels_of(m), band = ceil(bands_of(m) / count) + 2;
    r->pixels = m->photon_plan == IN_PASSES ? all : r->pixels + chunks * chunk_pixels(m);
    if (m->reduction == BANDS)
        r->pixels = fmin(r->pixels, band * chunk_pixels(m));
    r->pixels = fmin(r->pixels, all);
}

/* ---- Films ----------------------------------------------------------------------------------- */

/* Seconds in which a rank receives a film and adds it. */
static double receive(const model *m, double pixels)
{
    const double sums = pixels * m->planes;
    return m->latency + sums * (m->pixel_bytes / m->bandwidth + m->decode + m->add);
}

static double encode(const model *m, double pixels)
{
    return pixels * m->planes * m->encode;
}

/*
 * Whether a rank that asks for work is to hand its film over first: not more often than rank 0 has
 * time for, but in the end.
 */
static int must_hand_over(simulation *s, const rank *r)
{
    const model *m = s->m;
    const double age = r->at - r->saved;
    if (m->guided == 0 || age < m->every || (r->at < s->rested && age < m->late * m->every))
        return 0;
    s->rested = fmax(s->rested, r->at) + receive(m, r->pixels) / m->taking;
    return 1;
}

/* When a film that leaves a rank now is in safety. Those that are late all come together. */
static double hand_over(simulation *s, const rank *r)
{
    const model *m = s->m;
    const double t = r->at + encode(m, r->pixels);
    if (s->count == 1)
        return t;
    if (m->reduction == TREE && r->at - r->saved >= m->late * m->every)
        return t + ceil(log2(s->count)) * receive(m, pixels_of(m));
    s->received = fmax(s->received, t) + receive(m, r->pixels);
    return s->received;
}

/* When the film of a part is in its file. */
static double save(const model *m, const rank *r, double t)
{
    return t + encode(m, r->pixels) + r->pixels * m->planes * m->pixel_bytes / m->bandwidth;
}

static int earlier(const void *a, const void *b)
{
    const rank *x = a, *y = b;
    return (x->at > y->at) - (x->at < y->at);
}

/* When rank 0, or who merges the parts, has the sum of all films. */
static double reduce(simulation *s)
{
    const model *m = s->m;
    rank *r = s->ranks;
    double t = 0;
    if (s->count == 1)
        return r->at;
    /* Films add up in any order, so that none waits for a slow one. */
    qsort(r, (size_t)s->count, sizeof *r, earlier);
    if (m->reduction != TREE) {
        for (int i = m->schedule == BY_DEMAND; i < s->count; i++)
            t = fmax(t, r[i].at + encode(m, r[i].pixels)) + receive(m, r[i].pixels);
        return fmax(t, r[0].at);
    }
    for (int n = s->count; n > 1; n = (n + 1) / 2) {
        for (int i = 0; i + 1 < n; i += 2) {
            const rank *from = r + i + 1;
            t = fmax(r[i].at, from->at + encode(m, from->pixels)) + receive(m, from->pixels);
            r[i / 2] = r[i];
            r[i / 2].at = t;
            r[i / 2].pixels = fmin(r[i].pixels + from->pixels, pixels_of(m));
        }
        if (n % 2)
            r[n / 2] = r[n - 1];
    }
    return r[0].at;
}

/* ---- Who renders what ------------------------------------------------------------------------ */

/* Moves the first rank of a heap, whose time has grown, to its place. */
static void sink(rank *heap, int count)
{
    for (int i = 0, least;; i = least) {
        least = i;
        for (int child = 2 * i + 1; child < count && child <= 2 * i + 2; child++)
            least = heap[child].at < heap[least].at ? child : least;
        if (least == i)
            return;
        const rank other = heap[i];
        heap[i] = heap[least];
        heap[least] = other;
    }
}

/* The samples of the next chunks, and how many these are; `given` is counted on. */
static double next_task(simulation *s, double *given, double all, double *count)
{
    const model *m = s->m;
    const double left = all - *given;
    *count = floor(all / (m->tasks * s->count)) + 1;
    if (m->guided > 0)
        *count = fmin(*count, fmax(floor(left / (m->guided * s->count)), 1));
    *count = fmin(*count, left);
    const double from = m->largest_first ? left - *count : *given;
    *given += *count;
    return samples_before(m, from + *count) - samples_before(m, from);
}

/* Rank 0 hands out the chunks. */
static void render_by_demand(simulation *s)
{
    const model *m = s->m;
    const double all = chunks_of(m);
    double given = 0, count;
    rank *r = s->ranks;

    qsort(r, (size_t)s->count, sizeof *r, earlier);
    /* The heap keeps the rank that asks next in front; those that are done are behind it. */
    for (int asking = s->count; asking > 0;) {
        if (must_hand_over(s, r)) {
            r->at = r->saved = hand_over(s, r);
            r->pixels = 0;
        } else if (given < all) {
            const double samples = next_task(s, &given, all, &count);
            s->busy = fmax(s->busy, r->at + m->latency) + m->serve;
            r->at = s->busy + m->latency + work(s, samples, count, count) / r->speed;
            cover(m, r, count, s->count);
        } else {
            const rank done = r[0];
            r[0] = r[--asking];
            r[asking] = done;
        }
        sink(r, asking);
    }
}

/* From one film of a rank to the next. */
static double interval(const model *m, int count)
{
    const double share = count > 1 ? count * receive(m, pixels_of(m)) / m->taking : 0;
    return fmax(m->every, fmin(share, m->late * m->every));
}

/* The time of work in which failures undo all since the last checkpoint, one every so often. */
static double with_failures(simulation *s, double seconds, double life, double every)
{
    const model *m = s->m;
    double spent = 0, left = seconds;
    while (life > 0) {
        const double lived = -log(uniform(&s->random)) * life;
        if (lived >= left)
            break;
        left -= floor(lived / every) * every;
        spent += lived + m->relaunch;
    }
    return spent + left;
}

/*
 * Ranks take part after part, each of the chunks whose number leaves the same remainder. Those of a
 * part that bands divide lie in a few bands.
 */
static void render_parts(simulation *s)
{
    const model *m = s->m;
    const double parts = fmin(m->pieces * s->count, chunks_of(m)), chunks = chunks_of(m) / parts;
    const double samples = m->spp * pixels_of(m) / parts;
    const double own = m->reduction == BANDS ? fmax(bands_of(m) / parts, 1) : chunks;
    const double bands = fmin(own, bands_of(m)),
                 pixels = fmin(bands * chunk_pixels(m), pixels_of(m));
    rank *r = s->ranks;
    qsort(r, (size_t)s->count, sizeof *r, earlier);
    for (double part = 0; part < parts; part++) {
        rank alone = {.speed = r->speed, .pixels = pixels};
        const double seconds = work(s, samples, chunks, bands) / r->speed;
        const double saving = save(m, &alone, 0) * floor(seconds / m->every);
        const double begin = part < s->count ? 0 : m->start / r->speed;
        r->at += with_failures(s, begin + seconds + saving, m->life, m->every);
        r->pixels += pixels;
        sink(r, s->count);
    }
}

/* ---- Photon maps ----------------------------------------------------------------------------- */

/* Makes the ranks ready for their first chunk: they start and have their photons. */
static void make_ready(simulation *s)
{
    const model *m = s->m;
    const double photons = m->photons * m->stored;
    const double emit = m->photons * m->path, build = photons * m->tree;
    double last = 0;
    for (int i = 0; i < s->count; i++) {
        rank *r = s->ranks + i;
        double seconds = m->start;
        switch (m->photon_plan) {
        case NO_PHOTONS:
            break;
        case EMITTED_BY_EACH:
            seconds += emit + build;
            break;
        case EXCHANGED:
        case DIVIDED:
            seconds += emit / s->count;
            break;
        case IN_PASSES: /* the first radii, from the photons of the first pass */
            seconds += work(s, samples_before(m, 1), 1, 1);
            break;
        }
        r->at = seconds / r->speed;
        last = fmax(last, r->at);
    }
    if (m->photon_plan != EXCHANGED && m->photon_plan != DIVIDED)
        return;
    /* All wait for the last one, for the photons of the others, and for the tree. */
    const double share = m->photon_plan == DIVIDED ? 1 / m->slices : 1;
    const double hops = s->count > 1 ? 1 + ceil(log2(s->count)) : 0; /* to rank 0, then by a tree */
    const double passed = hops * photons * m->photon_bytes / m->bandwidth;
    for (int i = 0; i < s->count; i++)
        s->ranks[i].at = last + share * (passed + build / s->ranks[i].speed);
}

/* ---- A simulation ---------------------------------------------------------------------------- */

static double simulate(simulation *s)
{
    const model *m = s->m;
    /* Cores that all work share caches, memory and the power that their clocks have. */
    const int is_full = m->cores > 0 && s->count >= m->cores;
    const double shared = is_full ? m->cores / s->count / m->crowding : 1;
    for (int i = 0; i < s->count; i++) {
        const int is_slow = uniform(&s->random) < m->stragglers;
        const double speed = around_one(&s->random, m->speeds) / (is_slow ? m->straggling : 1);
        s->ranks[i] = (rank){.speed = s->count > 1 ? shared * speed : 1};
    }
    make_ready(s);
    if (m->schedule == IN_PARTS)
        render_parts(s);
    else
        render_by_demand(s);
    double t = reduce(s) + pixels_of(m) * m->resolve;
    if (m->schedule == BY_DEMAND && s->count > 1)
        t = with_failures(s, t, m->life / s->count, interval(m, s->count));
    return t;
}

double model_seconds(const model *m)
{
    const int count = (int)fmax(m->ranks, 1);
    const int repeats = count == 1 ? 1 : (int)fmax(m->repeats, fmin(50, 500 / count));
    rank *ranks = calloc((size_t)count, sizeof *ranks);
    double sum = 0;
    for (int i = 0; i < repeats && ranks; i++) {
        simulation s = {.m = m, .ranks = ranks, .count = count};
        s.random = 88172645463325252ull + 1000003ull * (uint64_t)m->seed + 7919ull * (uint64_t)i;
        sum += simulate(&s);
    }
    free(ranks);
    return ranks ? sum / repeats : -1;
}
