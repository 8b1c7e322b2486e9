/*
 * importance.h - starts of photon paths by visual importance: where the numbers that a start is
 * made of lie in the unit cube, by a table that a pilot has filled.
 *
 * A start is a function of numbers in [0,1): two for the point, two for the direction, those of
 * them that its light uses. Each light divides their cube into cells, and a cell is chosen with the
 * probability that its table gives: more often the more paths from there leave photons where the
 * camera gathers. The flux is divided by the density of that choice, so that every mean stays as it
 * was; and as each cell keeps a part of its probability, no weight is large.
 *
 * References:
 *   Peter, Pietrek: "Importance Driven Construction of Photon Maps", EGWR 1998.
 *   Hachisuka, Jensen: "Robust Adaptive Photon Tracing Using Photon Path Visibility", ACM
 *     Transactions on Graphics 30(5), 2011 (visibility as the target, in the space of the numbers).
 */
#ifndef RT_KERNELS_PHOTON_IMPORTANCE_H
#define RT_KERNELS_PHOTON_IMPORTANCE_H

#include "light/emit.h"
#include "sample/sample.h"

/*
 * How many bits of each coordinate, point and then direction, a division of a cell into 16 takes:
 * one of each of four, or two of each of two.
 */
static inline uint4 start_widths(global const rt_light_data *light)
{
    switch ((rt_light_kind)light->kind) {
    case RT_LIGHT_POINT:
    case RT_LIGHT_SPOT:
    case RT_LIGHT_TABLE:
        return (uint4)(0u, 0u, 2u, 2u);
    case RT_LIGHT_DIRECTIONAL:
    case RT_LIGHT_BEAM:
        return (uint4)(2u, 2u, 0u, 0u);
    case RT_LIGHT_ENVIRONMENT:
    case RT_LIGHT_QUAD:
    case RT_LIGHT_TRIANGLE:
    case RT_LIGHT_SPHERE:
    case RT_LIGHT_SHAPE:
        break;
    }
    return (uint4)(1u);
}

/* Where the bits of each coordinate begin in four of a cell's number. */
static inline uint4 start_shifts(uint4 widths)
{
    return (uint4)(0u, widths.x, widths.x + widths.y, widths.x + widths.y + widths.z);
}

/*
 * The cell of four numbers in [0,1), of 16^levels: the number of the cell that it is one of 16 of
 * is this one without its last four bits.
 */
static inline uint start_cell(uint4 widths, uint levels, float4 u)
{
    const uint4 sides = (uint4)(1u) << (widths * levels);
    const uint4 at = min(convert_uint4(u * convert_float4(sides)), sides - 1u);
    uint cell = 0u;
    for (uint i = levels; i-- > 0u;) {
        const uint4 part = (at >> (widths * i)) & (((uint4)(1u) << widths) - 1u);
        const uint4 four = part << start_shifts(widths);
        cell = cell << 4 | four.x | four.y | four.z | four.w;
    }
    return cell;
}

/* Four numbers in [0,1) as those of a cell. */
static inline float4 place_in_cell(uint4 widths, uint levels, uint cell, float4 u)
{
    const uint4 sides = (uint4)(1u) << (widths * levels);
    uint4 at = (uint4)(0u);
    for (uint i = levels; i-- > 0u;) {
        const uint4 four = (uint4)(cell >> (4u * i)) >> start_shifts(widths);
        at = (at << widths) | (four & (((uint4)(1u) << widths) - 1u));
    }
    return fmin((convert_float4(at) + u) / convert_float4(sides), (float4)(RT_BELOW_ONE));
}

/*
 * Moves the numbers of a start into a cell that start->w chooses, and returns what its flux is to
 * be multiplied by. The tables, sums of probabilities, lie behind the shares of the lights; where
 * there are none, the numbers stay.
 */
static inline float warp_start(const struct scene *scene, global const rt_light_share *shares,
                               float4 *start, float4 *turn)
{
    const uint lights = scene->header->light_count;
    if (lights == 0u || shares[0].levels == 0u)
        return 1.0f;

    /* Choose a cell of the light that these numbers choose. */
    const uint light = choose_emitter(shares, lights, start->z);
    global const rt_light_share *share = shares + light;
    global const float *sums = (global const float *)(shares + share->cells);
    const uint cells = 1u << (4u * share->levels);
    uint low = 0u, high = cells - 1u;
    while (low < high) {
        const uint middle = (low + high) >> 1;
        if (start->w < sums[middle])
            high = middle;
        else
            low = middle + 1u;
    }
    const float probability = sums[low] - (low > 0u ? sums[low - 1u] : 0.0f);

    /* Move the numbers there. */
    const float4 placed = place_in_cell(start_widths(scene->lights + light), share->levels, low,
                                        (float4)(start->xy, turn->xy));
    start->xy = placed.xy;
    turn->xy = placed.zw;
    return 1.0f / ((float)cells * probability);
}

#endif
