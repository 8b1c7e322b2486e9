/*
 * photon_radius.cl - what chooses the radii of pixels: tests of whether the photons within them are
 * even (photon/sectors.h), and how estimates change with the radius (photon/halvings.h).
 */
#include "entry.h"
#include "photon/halvings.h"
#include "photon/sectors.h"

/*
 * Adds the photons around gather points to the tests of their pixels, which are those of one sample
 * each. points: those from params.first_item on; header: as gather_tree has it.
 */
KERNEL count_sectors(const rt_params params, const rt_density_params estimate,
                     global const rt_gather_point *points, const rt_photon_tree shape,
                     global const rt_photon_node *nodes, global const rt_photon_block *blocks,
                     global const float *limits, global rt_radius_test *tests,
                     global const rt_scene_header *header)
{
    const uint item = item_number();
    const uint begin = item * estimate.points_an_item,
               end = min(begin + estimate.points_an_item, params.item_count);
    struct photon_tree tree;
    points += params.first_item;
    tree.shape = shape;
    tree.nodes = nodes;
    tree.blocks = blocks;
    struct photon_start start;
    if (begin < end)
        start = start_of_points(&tree, points + begin, end - begin, &estimate, limits);
    for (uint i = begin; i < end; i++) {
        if (!gathers_photons(points + i))
            continue;
        const struct photon_query query = query_of_point(points + i, header);
        const struct sector_sums sums =
            sectors_within(&tree, &start, &query, point_limit(points + i, &estimate, limits));
        const float weight = mean3(row3(points[i].weight));
        global rt_radius_test *const test = tests + points[i].pixel;
        for (uint s = 0u; s < RT_RADIUS_SECTORS; s++) {
            const float light = weight * estimate.scale * sums.light[s];
            test->count[s] += sums.count[s];
            test->light[s] += light;
            test->square[s] += light * light;
        }
        test->passes++;
    }
}

/*
 * Tests the pixels whose number of passes since the last change of the radius is a power of 2, and
 * halves the squared radius of those whose photons are not even. critical: [rule][log2 passes]
 */
KERNEL test_sectors(uint pixels, uint rule, uint fewest, global const float *critical,
                    global float *limits, global rt_radius_test *tests)
{
    const uint item = item_number();
    if (item >= pixels)
        return;
    global rt_radius_test *const test = tests + item;
    const uint passes = test->passes;
    uint count = 0u;
    for (uint i = 0u; i < RT_RADIUS_SECTORS; i++)
        count += test->count[i];
    if (count < fewest || popcount(passes) != 1)
        return;
    const uint row = min(31u - clz(passes), RT_RADIUS_LENGTHS - 1u);
    const float statistic = rule == RT_RADIUS_FTEST ? f_of(test) : chi_square_of(test);
    if (!(statistic > critical[row]))
        return;
    /*
     * Along an edge the disc stays as uneven as it is while it shrinks, so that the statistic falls
     * with the number of photons: halve as often as the next test would fail again.
     */
    float squared = limits[item];
    for (float excess = statistic; excess > critical[row]; excess *= 0.5f)
        squared *= 0.5f;
    limits[item] = squared;
    const rt_radius_test none = {{0u}, {0.0f}, {0.0f}, 0u, {0u}};
    *test = none;
}

/* Adds how the estimates at gather points change to the trials of their pixels; see above. */
KERNEL halve_discs(const rt_params params, const rt_density_params estimate,
                   global const rt_gather_point *points, const rt_photon_tree shape,
                   global const rt_photon_node *nodes, global const rt_photon_block *blocks,
                   global const float *limits, global rt_radius_trial *trials,
                   global const rt_scene_header *header)
{
    const uint item = item_number();
    const uint begin = item * estimate.points_an_item,
               end = min(begin + estimate.points_an_item, params.item_count);
    struct photon_tree tree;
    points += params.first_item;
    tree.shape = shape;
    tree.nodes = nodes;
    tree.blocks = blocks;
    struct photon_start start;
    if (begin < end)
        start = start_of_points(&tree, points + begin, end - begin, &estimate, limits);
    for (uint i = begin; i < end; i++) {
        if (!gathers_photons(points + i))
            continue;
        const struct photon_query query = query_of_point(points + i, header);
        const struct halving_sums sums = sums_of_halvings(
            &tree, &start, &query, &estimate, point_limit(points + i, &estimate, limits));
        global rt_radius_trial *const trial = trials + points[i].pixel;
        for (uint l = 0u; l < RT_RADIUS_HALVINGS; l++) {
            const float change = sums.light[l] - sums.light[l + 1u];
            trial->change[l] += change;
            trial->square[l] += square(change);
        }
        trial->variance[0] += sums.squares[0];
        trial->variance[1] += sums.squares[1];
        trial->passes++;
    }
}
