/* cut_off.c - the light that max_depth cuts off, summed over blocks of the film and the ledger. */
#include "film/cut_off.h"

#include <math.h>

#include "base/progress.h"

enum {
    block_side = 16,  /* pixels */
    longest_asked = 2 /* max_depth up to which light is left out on purpose: it is direct light */
};

/* Of the light, above which it is a fault: shipped scenes lose less than 1.6 % in any block. */
static const double share_most = 0.02;

/* The throughput that was cut off, and that of all paths. */
typedef struct share {
    double cut_off, all;
} share;

static double quotient(share of)
{
    return of.all > 0 ? of.cut_off / of.all : 0;
}

/* Of a square of so many pixels. */
static share share_of(const rt_film *film, uint32_t left, uint32_t top, uint32_t side)
{
    uint32_t width = film->options.width, height = film->options.height;
    share sum = {0, 0};
    for (uint32_t y = top; y < height && y - top < side; y++)
        for (uint32_t x = left; x < width && x - left < side; x++) {
            for (uint32_t r = 0; r < film->units.replicates; r++) {
                const rt_film_pixel *p =
                    film->pixels + r * rt_film_pixels(film) + (size_t)y * width + x;
                sum.cut_off += RT_FILM_CUT_OFF * (double)p->cut_off;
                sum.all += p->count;
            }
        }
    return sum;
}

static share flux_of(const rt_ledger *ledger)
{
    share sum = {0, 0};
    for (size_t i = 0; i < ledger->count; i++) {
        rt_light_ledger row;
        rt_ledger_read(ledger, i, &row);
        for (int c = 0; c < 3; c++) {
            sum.cut_off += row.cut_off[c];
            sum.all += row.emitted[c];
        }
    }
    return sum;
}

/*
 * Whether more is cut off than may be, by three standard errors: a path is cut off with a
 * throughput of at most 1, so the variance of the sum is at most the sum.
 */
static int is_surely_large(share of)
{
    return of.cut_off - 3 * sqrt(of.cut_off) > share_most * of.all;
}

/* Sets the figures of camera paths; whether a block loses too much. */
static int check_blocks(rt_film *film)
{
    rt_film_stats *stats = &film->stats;
    share whole = {0, 0};
    int is_large = 0;
    stats->cut_off_in_block = 0;
    for (uint32_t y = 0; y < film->options.height; y += block_side)
        for (uint32_t x = 0; x < film->options.width; x += block_side) {
            share block = share_of(film, x, y, block_side);
            whole.cut_off += block.cut_off;
            whole.all += block.all;
            stats->cut_off_in_block = fmax(stats->cut_off_in_block, quotient(block));
            is_large |= is_surely_large(block);
        }
    stats->cut_off_throughput = quotient(whole);
    return is_large;
}

void rt_film_check_cut_off(rt_film *film, const rt_hooks *hooks)
{
    static const char advice[] =
        "raise it; each face of glass takes a segment, and each scattering in a medium, which in "
        "dense ones cuts off some light whatever it is";
    const rt_film_stats *stats = &film->stats;
    unsigned max_depth = film->options.max_depth;
    int is_large = check_blocks(film);
    film->stats.cut_off_flux = quotient(flux_of(&film->ledger));
    if (max_depth <= longest_asked)
        return;
    if (stats->cut_off_flux > share_most)
        rt_warn(hooks,
                "max_depth %u cuts off %.3g %% of the flux of photon paths, seen by the camera or "
                "not, and %.3g %% of the throughput of camera paths, up to %.3g %% in a part of "
                "the picture: what is seen of it is too dark; %s",
                max_depth, 100 * stats->cut_off_flux, 100 * stats->cut_off_throughput,
                100 * stats->cut_off_in_block, advice);
    else if (is_large)
        rt_warn(hooks,
                "max_depth %u cuts off %.3g %% of the throughput of camera paths, up to %.3g %% in "
                "a part of the picture, which is too dark: %s",
                max_depth, 100 * stats->cut_off_throughput, 100 * stats->cut_off_in_block, advice);
}
