/* test_volume_tree.c - the tree of volume photons: radii and boxes, against brute force. */
#include "support.h"

#include <math.h>
#include <stdlib.h>

#include "photon/volume_tree.h"

enum { COUNT = 1003 };

/* Photons that grow denser towards the origin, of two media. */
static void scatter(rt_photon photons[COUNT])
{
    uint32_t state = 7;
    for (size_t i = 0; i < COUNT; i++) {
        rt_photon p = {.shape = i % 3 ? RT_NONE : 4, .shading = 1, .flux = {1, 2, (float)i}};
        for (int c = 0; c < 3; c++) {
            state = state * 1664525u + 1013904223u;
            const float x = (float)(state >> 8) / (1 << 24);
            p.position[c] = x * x * x;
        }
        photons[i] = p;
    }
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

/* The distance of the k-th nearest photon to the middle of a block's. */
static double nearest(const rt_photon *photons, const rt_photon_block *block, size_t in_block,
                      size_t k)
{
    double middle[3] = {0}, distances[COUNT];
    for (size_t i = 0; i < in_block; i++)
        for (int c = 0; c < 3; c++)
            middle[c] += block->position[c][i] / (double)in_block;
    for (size_t i = 0; i < COUNT; i++) {
        double sum = 0;
        for (int c = 0; c < 3; c++)
            sum += pow(photons[i].position[c] - middle[c], 2);
        distances[i] = sqrt(sum);
    }
    qsort(distances, COUNT, sizeof *distances, compare);
    return distances[k < COUNT ? k - 1 : COUNT - 1];
}

static size_t in_block(size_t block)
{
    return COUNT - 8 * block < 8 ? COUNT - 8 * block : 8;
}

static void expect_radii(const rt_volume_radii *radii)
{
    static rt_photon photons[COUNT];
    rt_photon_tree_data tree;
    rt_error error;
    size_t limited = 0;
    scatter(photons);
    const rt_photon_list list = {.photons = photons, .count = COUNT};
    expect_ok(rt_volume_tree_build(&tree, &list, radii, 3, NULL, &error), &error);
    for (size_t b = 0; b < tree.shape.block_count; b++) {
        const rt_photon_block *block = tree.blocks + b;
        double radius =
            radii->k ? nearest(photons, block, in_block(b), radii->k) : radii->max_radius;
        if (radii->max_radius > 0 && radius > radii->max_radius) {
            radius = radii->max_radius;
            limited++;
        }
        for (size_t i = 0; i < in_block(b); i++) {
            const rt_photon *photon = photons + (size_t)block->flux[2][i];
            assert_float_equal(block->normal[RT_VOLUME_RADIUS][i], radius * radii->factor,
                               1e-5 * radius);
            assert_float_equal(block->normal[RT_VOLUME_MEDIUM][i], photon->shape == 4 ? 5 : 0, 0);
        }
    }
    assert_true(radii->k == 0 || radii->max_radius == 0 || (limited > 5 && limited < 120));
    rt_photon_tree_free(&tree);
}

static void radii_are_those_of_the_kth_nearest(void **state)
{
    (void)state;
    expect_radii(&(rt_volume_radii){20, 0, 1});
    expect_radii(&(rt_volume_radii){20, 0.1f, 0.5});
    expect_radii(&(rt_volume_radii){0, 0.3f, 2});
    expect_radii(&(rt_volume_radii){60000, 0, 1});
}

/* Each sphere lies in the box of its block, and that in the box of the node above. */
static void boxes_hold_spheres(void **state)
{
    static rt_photon photons[COUNT];
    rt_photon_tree_data tree;
    rt_error error;
    (void)state;
    scatter(photons);
    const rt_photon_list list = {.photons = photons, .count = COUNT};
    expect_ok(rt_volume_tree_build(&tree, &list, &(rt_volume_radii){10, 0, 1}, 2, NULL, &error),
              &error);
    assert_int_equal(tree.shape.levels, 3);
    for (size_t b = 0; b < tree.shape.block_count; b++)
        for (rt_u32 level = 0, child = (rt_u32)b; level < tree.shape.levels; level++, child /= 8) {
            const rt_photon_node *node = tree.nodes + tree.shape.first_node[level] + child / 8;
            for (size_t i = 0; i < in_block(b); i++)
                for (int c = 0; c < 3; c++) {
                    const float x = tree.blocks[b].position[c][i],
                                r = tree.blocks[b].normal[RT_VOLUME_RADIUS][i];
                    assert_true(node->bounds[c][child % 8] <= x - r);
                    assert_true(node->bounds[3 + c][child % 8] >= x + r);
                }
        }
    rt_photon_tree_free(&tree);
}

static void no_photons_make_an_empty_tree(void **state)
{
    const rt_photon_list list = {0};
    rt_photon_tree_data tree;
    rt_error error;
    (void)state;
    expect_ok(rt_volume_tree_build(&tree, &list, &(rt_volume_radii){20, 0, 1}, 2, NULL, &error),
              &error);
    assert_int_equal(tree.shape.levels, 0);
    rt_photon_tree_free(&tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(radii_are_those_of_the_kth_nearest),
        cmocka_unit_test(boxes_hold_spheres),
        cmocka_unit_test(no_photons_make_an_empty_tree),
    };
    return cmocka_run_group_tests_name("photon/volume_tree", tests, NULL, NULL);
}
