/*
 * test_bvh.c - the tree holds every primitive once, inside its boxes, and is the same for any
 * number of threads.
 */
#include "accel/bvh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "accel/pairs.h"
#include "kernels/rays.h"
#include "support.h"

/* A tree as it would be uploaded. */
typedef struct written {
    rt_bvh_counts counts;
    rt_bvh_node *nodes;
    rt_tri_block *blocks;
    uint32_t *analytic;
} written;

static written build(const rt_bvh_input *input, uint32_t threads)
{
    written out;
    rt_bvh *bvh = NULL;
    rt_error error;
    expect_ok(rt_bvh_build(&bvh, input, threads, NULL, &error), &error);
    rt_bvh_get_counts(bvh, &out.counts);
    out.nodes = calloc(out.counts.nodes, sizeof *out.nodes);
    out.blocks = calloc(out.counts.blocks + 1, sizeof *out.blocks);
    out.analytic = calloc(out.counts.analytic + 1, sizeof *out.analytic);
    rt_bvh_write(bvh, out.nodes, out.blocks, out.analytic, 0, 0);
    rt_bvh_destroy(bvh);
    return out;
}

static void release(written *tree)
{
    free(tree->nodes);
    free(tree->blocks);
    free(tree->analytic);
}

/* What a traversal of the whole tree finds. */
typedef struct traversal {
    const written *tree;
    const rt_bvh_input *input;
    uint32_t *seen;          /* [prims], how often each triangle or quad was met */
    uint32_t *seen_analytic; /* [shapes] */
    uint32_t nodes, blocks, analytic;
} traversal;

static void expect_inside(const float p[3], const float lo[3], const float hi[3])
{
    for (int a = 0; a < 3; a++) {
        assert_true(p[a] >= lo[a]);
        assert_true(p[a] <= hi[a]);
    }
}

static void visit_block(traversal *w, uint32_t index, const float lo[3], const float hi[3])
{
    assert_true(index < w->tree->counts.blocks);
    const rt_tri_block *block = &w->tree->blocks[index];
    w->blocks++;
    assert_int_not_equal(block->prim[0], RT_NONE);
    for (int lane = 0; lane < RT_BVH_WIDTH; lane++) {
        if (block->prim[lane] == RT_NONE)
            continue;
        w->seen[block->prim[lane] & RT_BLOCK_PRIM]++;
        float v[4][3];
        for (int a = 0; a < 3; a++) {
            v[0][a] = block->v0[a][lane];
            v[1][a] = block->v1[a][lane];
            v[2][a] = block->v2[a][lane];
            v[3][a] = v[1][a] + (v[2][a] - v[0][a]);
        }
        const int corners = block->prim[lane] & RT_BLOCK_QUAD ? 4 : 3;
        for (int c = 0; c < corners; c++)
            expect_inside(v[c], lo, hi);
    }
}

static void visit_analytic(traversal *w, uint32_t index, const float lo[3], const float hi[3])
{
    assert_true(index < w->tree->counts.analytic);
    const uint32_t shape = w->tree->analytic[index];
    w->analytic++;
    for (uint32_t i = 0; i < w->input->analytic_count; i++)
        if (w->input->analytic[i].shape == shape) {
            w->seen_analytic[i]++;
            expect_inside(w->input->analytic[i].lo, lo, hi);
            expect_inside(w->input->analytic[i].hi, lo, hi);
        }
}

/* Returns the entries that the node's visit adds to a traversal's stack at most. */
static uint32_t visit_node(traversal *w, uint32_t index, const float *lo, const float *hi)
{
    assert_true(index < w->tree->counts.nodes);
    const rt_bvh_node *node = &w->tree->nodes[index];
    uint32_t children = 0, deepest = 1;
    w->nodes++;
    for (int lane = 0; lane < RT_BVH_WIDTH; lane++) {
        const uint32_t child = node->child[lane];
        float child_lo[3], child_hi[3];
        for (int a = 0; a < 3; a++) {
            child_lo[a] = node->bounds[a][lane];
            child_hi[a] = node->bounds[3 + a][lane];
        }
        if (child == RT_NONE) {
            assert_true(isinf(child_lo[0]) && child_lo[0] > 0 && isinf(child_hi[0]) &&
                        child_hi[0] < 0);
            continue;
        }
        children++;
        if (lo) {
            expect_inside(child_lo, lo, hi);
            expect_inside(child_hi, lo, hi);
        }
        if (child & RT_CHILD_LEAF && child & RT_CHILD_ANALYTIC) {
            visit_analytic(w, child & RT_CHILD_INDEX, child_lo, child_hi);
        } else if (child & RT_CHILD_LEAF) {
            visit_block(w, child & RT_CHILD_INDEX, child_lo, child_hi);
        } else {
            const uint32_t below = visit_node(w, child, child_lo, child_hi);
            deepest = below > deepest ? below : deepest;
        }
    }
    return children ? children - 1 + deepest : 0;
}

static void expect_sound_pairs(const rt_bvh_input *input);

/* Builds with one thread and with several, and checks everything that must hold of the result. */
static void expect_sound(const rt_bvh_input *input, uint32_t prims)
{
    written tree = build(input, 1);
    traversal w = {&tree,
                   input,
                   calloc(prims + 1, sizeof(uint32_t)),
                   calloc(input->analytic_count + 1, sizeof(uint32_t)),
                   0,
                   0,
                   0};
    const uint32_t stack = visit_node(&w, 0, NULL, NULL);
    assert_true(stack <= RT_BVH_STACK);
    assert_int_equal(w.nodes, tree.counts.nodes);
    assert_int_equal(w.blocks, tree.counts.blocks);
    assert_int_equal(w.analytic, tree.counts.analytic);
    for (uint32_t i = 0; i < prims; i++)
        assert_int_equal(w.seen[i], 1);
    for (uint32_t i = 0; i < input->analytic_count; i++)
        assert_int_equal(w.seen_analytic[i], 1);

    for (uint32_t threads = 2; threads <= 5; threads += 3) {
        written other = build(input, threads);
        assert_memory_equal(&other.counts, &tree.counts, sizeof tree.counts);
        assert_memory_equal(other.nodes, tree.nodes, tree.counts.nodes * sizeof *tree.nodes);
        assert_memory_equal(other.blocks, tree.blocks, tree.counts.blocks * sizeof *tree.blocks);
        assert_memory_equal(other.analytic, tree.analytic,
                            tree.counts.analytic * sizeof *tree.analytic);
        release(&other);
    }
    free(w.seen);
    free(w.seen_analytic);
    release(&tree);
    expect_sound_pairs(input);
}

/* ---- Two-wide nodes ------------------------------------------------------------------------ */

typedef struct pair_traversal {
    const written *tree;
    const rt_pair_node *nodes;
    uint32_t *seen; /* [blocks][RT_BVH_WIDTH] */
    uint32_t visited, analytic;
} pair_traversal;

static void visit_lanes(pair_traversal *w, uint32_t index, uint32_t lanes, const float bounds[6])
{
    const rt_tri_block *block = &w->tree->blocks[index];
    assert_true(lanes != 0 && index < w->tree->counts.blocks);
    for (int lane = 0; lane < RT_BVH_WIDTH; lane++) {
        if (!(lanes >> lane & 1u))
            continue;
        w->seen[index * RT_BVH_WIDTH + (uint32_t)lane]++;
        for (int corner = 0; corner < (block->prim[lane] & RT_BLOCK_QUAD ? 4 : 3); corner++) {
            float p[3];
            for (int a = 0; a < 3; a++)
                p[a] = corner == 0   ? block->v0[a][lane]
                       : corner == 1 ? block->v1[a][lane]
                       : corner == 2
                           ? block->v2[a][lane]
                           : block->v1[a][lane] + (block->v2[a][lane] - block->v0[a][lane]);
            expect_inside(p, bounds, bounds + 3);
        }
    }
}

/* Returns the levels of the node and all below it; bounds NULL: those of the root. */
static uint32_t visit_pair(pair_traversal *w, uint32_t index, const float *bounds)
{
    const rt_pair_node *node = &w->nodes[index];
    uint32_t deepest = 0;
    w->visited++;
    for (int side = 0; side < 2; side++) {
        const float *own = node->bounds[side];
        const uint32_t child = node->child[side];
        if (child == RT_NONE) {
            assert_true(own[0] > own[3]);
            continue;
        }
        if (bounds) {
            expect_inside(own, bounds, bounds + 3);
            expect_inside(own + 3, bounds, bounds + 3);
        }
        if (child & RT_CHILD_LEAF && child & RT_CHILD_ANALYTIC) {
            w->analytic++;
        } else if (child & RT_CHILD_LEAF) {
            visit_lanes(w, child & RT_CHILD_INDEX, node->lanes[side], own);
        } else {
            const uint32_t below = visit_pair(w, child, own);
            deepest = below > deepest ? below : deepest;
        }
    }
    return deepest + 1;
}

/* Each lane and each analytic shape is in one leaf, within the boxes above it. */
static void expect_sound_pairs(const rt_bvh_input *input)
{
    rt_bvh_input with_pairs = *input;
    with_pairs.has_pairs = 1;
    written tree = build(&with_pairs, 1);
    const uint64_t most = rt_pairs_most(&tree.counts);
    const size_t lanes = (size_t)tree.counts.blocks * RT_BVH_WIDTH;
    rt_pair_node *nodes = calloc(3 + most, sizeof *nodes);
    pair_traversal w = {&tree, nodes, calloc(lanes + 1, sizeof *w.seen), 0, 0};
    const uint32_t count = rt_pairs_write(nodes, 3, tree.nodes, 0, tree.blocks);
    assert_true(count <= most);
    assert_true(visit_pair(&w, 3, NULL) <= RT_PAIR_STACK);
    assert_int_equal(w.visited, count);
    assert_int_equal(w.analytic, tree.counts.analytic);
    for (size_t i = 0; i < lanes; i++)
        assert_int_equal(w.seen[i],
                         tree.blocks[i / RT_BVH_WIDTH].prim[i % RT_BVH_WIDTH] != RT_NONE);
    free(w.seen);
    free(nodes);
    release(&tree);
}

/* ---- Inputs -------------------------------------------------------------------------------- */

/* A mesh of loose triangles, one for each call of place. */
typedef void place_triangle(uint32_t index, rays_stream *stream, float v[3][3]);

static void expect_sound_mesh(uint32_t count, place_triangle *place)
{
    float *positions = malloc((count + 1) * 9 * sizeof *positions);
    uint32_t *indices = malloc((count + 1) * 3 * sizeof *indices);
    rays_stream stream = {7};
    for (uint32_t i = 0; i < count; i++) {
        float v[3][3];
        place(i, &stream, v);
        memcpy(positions + 9 * (size_t)i, v, sizeof v);
        for (uint32_t c = 0; c < 3; c++)
            indices[3 * i + c] = 3 * i + c;
    }
    const rt_bvh_mesh mesh = {positions, indices, count, 0};
    const rt_bvh_input input = {.meshes = &mesh, .mesh_count = 1};
    expect_sound(&input, count);
    free(positions);
    free(indices);
}

static void place_anywhere(uint32_t index, rays_stream *stream, float v[3][3])
{
    (void)index;
    float centre[3];
    rays_point(stream, 10.0f, centre);
    for (int c = 0; c < 3; c++) {
        rays_point(stream, 0.2f, v[c]);
        for (int a = 0; a < 3; a++)
            v[c][a] += centre[a];
    }
}

static void place_at_origin(uint32_t index, rays_stream *stream, float v[3][3])
{
    (void)index;
    (void)stream;
    const float same[3][3] = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
    memcpy(v, same, sizeof same);
}

static void place_point(uint32_t index, rays_stream *stream, float v[3][3])
{
    (void)index;
    rays_point(stream, 1.0f, v[0]);
    memcpy(v[1], v[0], sizeof v[0]);
    memcpy(v[2], v[0], sizeof v[0]);
}

static void place_flat(uint32_t index, rays_stream *stream, float v[3][3])
{
    place_anywhere(index, stream, v);
    for (int c = 0; c < 3; c++)
        v[c][1] = 0.25f;
}

/* Each twice as far and as large as the one before: splits that pay peel off one at a time. */
static void place_exponential(uint32_t index, rays_stream *stream, float v[3][3])
{
    (void)stream;
    const float size = ldexpf(1.0f, (int)(index % 180) - 90);
    for (int c = 0; c < 3; c++)
        for (int a = 0; a < 3; a++)
            v[c][a] = size * (float)(1 + (a == c) + (int)(index / 180 % 3) * (a == 0));
}

static void random_triangles_are_held(void **state)
{
    (void)state;
    static const uint32_t counts[] = {0, 1, 2, 7, 8, 9, 16, 17, 65, 1000, 20000, 200000};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
        expect_sound_mesh(counts[i], place_anywhere);
}

static void equal_centres_are_held(void **state)
{
    (void)state;
    expect_sound_mesh(9, place_at_origin);
    expect_sound_mesh(70000, place_at_origin);
}

static void degenerate_and_flat_sets_are_held(void **state)
{
    (void)state;
    expect_sound_mesh(3000, place_point);
    expect_sound_mesh(3000, place_flat);
}

static void exponential_sets_fit_the_stack(void **state)
{
    (void)state;
    expect_sound_mesh(180, place_exponential);
    expect_sound_mesh(5000, place_exponential);
}

/*
 * Wide nodes in a chain, each the least of its parent's eight children, of which each is four times
 * as large as the one before: by area, a two-wide node would part with one at a time.
 */
static void pairs_fit_the_stack(void **state)
{
    (void)state;
    enum { chain = 9, most = chain * RT_BVH_WIDTH };
    rt_bvh_node nodes[chain];
    rt_pair_node pairs[most];
    uint32_t analytic = 0;
    memset(nodes, 0, sizeof nodes);
    for (uint32_t n = 0; n < chain; n++)
        for (uint32_t lane = 0; lane < RT_BVH_WIDTH; lane++) {
            const float size = ldexpf(1.0f, 2 * (int)((chain - 1 - n) * 7 + lane) - 60);
            for (int a = 0; a < 3; a++) {
                nodes[n].bounds[a][lane] = lane == 0 && n + 1 < chain ? 0 : size;
                nodes[n].bounds[3 + a][lane] = 2 * size;
            }
            nodes[n].child[lane] =
                lane == 0 && n + 1 < chain ? n + 1 : analytic++ | RT_CHILD_LEAF | RT_CHILD_ANALYTIC;
        }
    const written tree = {{chain, 0, analytic}, nodes, NULL, NULL};
    pair_traversal w = {&tree, pairs, NULL, 0, 0};
    assert_int_equal(rt_pairs_write(pairs, 0, nodes, 0, NULL), analytic - 1);
    assert_true(visit_pair(&w, 0, NULL) <= 3 * chain);
    assert_int_equal(w.analytic, analytic);
}

static void kinds_mix(void **state)
{
    (void)state;
    enum { quads = 300, entries = 200, triangles = 500 };
    static rt_bvh_quad quad[quads];
    static rt_bvh_analytic entry[entries];
    static float positions[triangles + 2][3];
    static uint32_t indices[triangles][3];
    rays_stream stream = {11};
    for (uint32_t i = 0; i < triangles + 2; i++)
        rays_point(&stream, 2.0f, positions[i]);
    for (uint32_t i = 0; i < triangles; i++)
        for (uint32_t c = 0; c < 3; c++)
            indices[i][c] = i + c;
    for (uint32_t i = 0; i < quads; i++) {
        rays_point(&stream, 2.0f, quad[i].corner);
        rays_point(&stream, 0.3f, quad[i].edge1);
        rays_point(&stream, 0.3f, quad[i].edge2);
        quad[i].prim = triangles + i;
    }
    for (uint32_t i = 0; i < entries; i++) {
        rays_point(&stream, 2.0f, entry[i].lo);
        for (int a = 0; a < 3; a++)
            entry[i].hi[a] = entry[i].lo[a] + 0.1f;
        entry[i].shape = 1000 + i;
    }
    /* The first two entries lie at one place. */
    memcpy(entry[1].lo, entry[0].lo, sizeof entry[0].lo);
    memcpy(entry[1].hi, entry[0].hi, sizeof entry[0].hi);
    const rt_bvh_mesh meshes[2] = {{positions[0], indices[0], 200, 0},
                                   {positions[0], indices[200], 300, 200}};
    const rt_bvh_input input = {meshes, 2, quad, quads, entry, entries, NULL, 0};
    expect_sound(&input, triangles + quads);
    const rt_bvh_input only_entries = {.analytic = entry, .analytic_count = 2};
    expect_sound(&only_entries, 0);
}

static int cancel_at_once(void *user, const rt_progress *progress)
{
    (void)progress;
    ++*(int *)user;
    return 1;
}

static void progress_cancels(void **state)
{
    (void)state;
    static float positions[200000][3];
    static uint32_t indices[199998][3];
    rays_stream stream = {3};
    for (uint32_t i = 0; i < 200000; i++)
        rays_point(&stream, 1.0f, positions[i]);
    for (uint32_t i = 0; i < 199998; i++)
        for (uint32_t c = 0; c < 3; c++)
            indices[i][c] = i + c;
    const rt_bvh_mesh mesh = {positions[0], indices[0], 199998, 0};
    const rt_bvh_input input = {.meshes = &mesh, .mesh_count = 1};
    int calls = 0;
    const rt_hooks hooks = {.progress = cancel_at_once, .user = &calls};
    rt_stage_progress progress;
    rt_error error;
    rt_bvh *bvh = NULL;
    rt_stage_begin(&progress, &hooks, RT_STAGE_BUILD);
    assert_int_equal(rt_bvh_build(&bvh, &input, 2, &progress, &error), RT_CANCELLED);
    assert_int_equal(error.status, RT_CANCELLED);
    assert_null(bvh);
    assert_true(calls > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_triangles_are_held),
        cmocka_unit_test(equal_centres_are_held),
        cmocka_unit_test(degenerate_and_flat_sets_are_held),
        cmocka_unit_test(exponential_sets_fit_the_stack),
        cmocka_unit_test(pairs_fit_the_stack),
        cmocka_unit_test(kinds_mix),
        cmocka_unit_test(progress_cancels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
