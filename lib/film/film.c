/* film.c - a film made, resolved to means, and read by the caller. */
#include "film/film.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/progress.h"
#include "camera/film_sum.h"
#include "setting/options.h"
#include "setting/techniques.h"

/*
 * Bytes of the layers that these options ask for, and of an .exr file while it is made: its values,
 * and twice as much for their encoding.
 */
static uint64_t bytes_reserved(const rt_render_options *o)
{
    const uint64_t pixels = (uint64_t)o->width * o->height;
    uint64_t channels = 0, sums = 0;
    const int groups[] = {
        [RT_LAYERS_FIRST_HIT] = o->aov || !rt_mode_shows_light(o->mode),
        [RT_LAYERS_ERROR] = o->variance || o->target_error > 0,
        [RT_LAYERS_BOUND] = rt_error_bound_wanted(o),
        [RT_LAYERS_PHOTON] = o->photon_layers,
    };
    for (int i = 0; i < RT_FILM_LAYER_COUNT; i++)
        channels += groups[rt_layer_infos[i].group] ? rt_layer_infos[i].channels : 0;
    if (groups[RT_LAYERS_FIRST_HIT])
        sums = sizeof(rt_first_hits);
    return pixels * (sums + sizeof(float) * (channels + 3 * (3 + channels)));
}

static char *copy_text(const char *text)
{
    const size_t size = strlen(text) + 1;
    char *copy = malloc(size);
    return copy ? memcpy(copy, text, size) : NULL;
}

/* The settings, without what belongs to one call. */
static rt_render_options settings_of(const rt_render_options *options)
{
    rt_render_options o = *options;
    o.hooks = NULL;
    o.photon_map = NULL;
    o.light_shares = NULL;
    o.light_share_count = 0;
    o.hand_over = 0;
    o.resume = NULL;
    o.raised_from = 0;
    o.checkpoint = NULL;
    o.preview = NULL;
    o.checkpoint_user = o.preview_user = o.units_user = NULL;
    o.next_units = NULL;
    o.note = NULL;
    return o;
}

/* Bytes of a cache's line. */
enum { LINE = 64 };

/* The first line of a cache in some memory: a CPU device works on the film in place. */
static void *line_of(void *memory)
{
    const size_t beyond = (size_t)((uintptr_t)memory % LINE);
    return (uint8_t *)memory + (beyond > 0 ? LINE - beyond : 0);
}

rt_status rt_film_make_first_hits(rt_film *film, rt_error *error)
{
    const size_t pixels = rt_film_pixels(film);
    if (film->first_hits)
        return RT_OK;
    /* They count already, by bytes_reserved. */
    film->hit_memory = calloc(1, pixels * sizeof *film->first_hits + LINE);
    if (!film->hit_memory)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for the layers of %zu pixels",
                       pixels);
    film->first_hits = line_of(film->hit_memory);
    return RT_OK;
}

const char rt_film_owner[] = "the film";

/* Makes room for the sums and means. */
static rt_status create_sums(rt_film *film, rt_error *error)
{
    const rt_render_options *o = &film->options;
    const size_t count = rt_film_pixels(film), planes = film->units.replicates;
    const uint64_t reserved = bytes_reserved(o);
    const int has_moments =
        film->units.in_passes && (o->mode == RT_MODE_PHOTON || rt_vcm_merges(o));
    const double all =
        (double)count *
        ((planes + (has_moments ? RT_MOMENTS : 0)) * sizeof *film->pixels + 3 * sizeof *film->rgb);
    rt_status status =
        rt_memory_foresee(film->memory, (double)reserved + all, rt_film_owner, error);
    if (status == RT_OK)
        status = rt_memory_take(film->memory, reserved, rt_film_owner, error);
    if (status != RT_OK)
        return status;
    film->reserved = reserved;
    film->pixel_memory = rt_memory_zeroed(film->memory, planes * count + 1, sizeof *film->pixels,
                                          rt_film_owner, error);
    if (!film->pixel_memory)
        return RT_ERROR_MEMORY;
    film->pixels = line_of(film->pixel_memory);
    film->rgb = rt_memory_zeroed(film->memory, count, 3 * sizeof *film->rgb, rt_film_owner, error);
    if (!film->rgb)
        return RT_ERROR_MEMORY;
    if (has_moments) {
        film->moment_memory = rt_memory_zeroed(film->memory, RT_MOMENTS * count + 1,
                                               sizeof *film->moments, rt_film_owner, error);
        if (!film->moment_memory)
            return RT_ERROR_MEMORY;
        film->moments = line_of(film->moment_memory);
    }
    if (film->units.pilot > 0) {
        film->rates = rt_memory_zeroed(film->memory, count, sizeof *film->rates,
                                       "the rates of pixels", error);
        if (!film->rates)
            return RT_ERROR_MEMORY;
    }
    if (o->mode == RT_MODE_PHOTON && o->photon_layers) {
        film->photon_sums = rt_memory_zeroed(film->memory, count, sizeof *film->photon_sums,
                                             "the sums of photon layers", error);
        return film->photon_sums ? RT_OK : RT_ERROR_MEMORY;
    }
    return RT_OK;
}

rt_status rt_film_create(rt_film **out, const rt_render_options *options, rt_memory *memory,
                         rt_error *error)
{
    rt_film *film = calloc(1, sizeof *film);
    if (!film)
        return rt_fail(error, RT_ERROR_MEMORY, "out of memory for a film");
    film->made = rt_clock();
    film->memory = rt_memory_hold(memory);
    film->options = settings_of(options);
    film->units = rt_units_of(options, options->resume ? 0 : options->raised_from);
    film->lacks_base = film->units.base > 0;
    film->note = options->note ? copy_text(options->note) : NULL;
    rt_status status = options->note && !film->note
                           ? rt_fail(error, RT_ERROR_MEMORY, "out of memory for a film")
                           : create_sums(film, error);
    if (status == RT_OK)
        *out = film;
    else
        rt_film_destroy(film);
    return status;
}

void rt_film_destroy(rt_film *film)
{
    if (!film)
        return;
    rt_ledger_free(&film->ledger);
    rt_coverage_free(&film->done);
    free(film->note);
    rt_memory_free(film->pixel_memory);
    rt_memory_free(film->moment_memory);
    rt_memory_free(film->photon_sums);
    rt_memory_free(film->rates);
    rt_memory_free(film->rgb);
    free(film->hit_memory);
    rt_film_layers_free(&film->layers);
    rt_memory_give(film->memory, film->reserved, rt_film_owner);
    rt_memory_drop(film->memory);
    free(film);
}

void rt_film_clear(rt_film *film)
{
    const rt_film_stats before = film->stats;
    const size_t pixels = rt_film_pixels(film);
    memset(film->pixels, 0, rt_film_bytes(film));
    if (film->first_hits)
        memset(film->first_hits, 0, pixels * sizeof *film->first_hits);
    if (film->photon_sums)
        memset(film->photon_sums, 0, pixels * sizeof *film->photon_sums);
    if (film->moments)
        memset(film->moments, 0, rt_film_moment_bytes(film));
    film->done.count = 0;
    film->stats = (rt_film_stats){.light_power = before.light_power};
    if (film->units.in_passes) {
        rt_ledger_reset(&film->ledger);
        return;
    }
    /* Without passes the same photons serve all samples. */
    film->stats.photons_emitted = before.photons_emitted;
    film->stats.photons_stored = before.photons_stored;
    film->stats.photons_rejected = before.photons_rejected;
}

rt_status rt_film_check_exact(const rt_film *film, const char *what, rt_error *error)
{
    if (film->scene)
        return RT_OK;
    return rt_fail(error, RT_ERROR_USAGE,
                   "the film was rendered without a part (1 of 1 for the whole picture) or "
                   "checkpoint, and cannot be %s",
                   what);
}

size_t rt_film_pixels(const rt_film *film)
{
    return (size_t)film->options.width * film->options.height;
}

size_t rt_film_bytes(const rt_film *film)
{
    return rt_film_pixels(film) * film->units.replicates * sizeof *film->pixels;
}

size_t rt_film_moment_bytes(const rt_film *film)
{
    return film->moments ? rt_film_pixels(film) * RT_MOMENTS * sizeof *film->moments : 0;
}

void rt_film_join_pixels(rt_film_pixel *pixels, const rt_film_pixel *others, size_t count)
{
    for (size_t i = 0; i < count; i++)
        film_join(pixels + i, others + i);
}

/* The sum of what two neighbouring bins hold: bin b counts units of 2^(32 b - 149). */
static double sum_of(int64_t high, int64_t low, uint32_t bin)
{
    static const double units[] = {0x1p-149, 0x1p-117, 0x1p-85, 0x1p-53, 0x1p-21, 0x1p11,
                                   0x1p43,   0x1p75,   0x1p107, 0x1p139, 0x1p171, 0x1p203,
                                   0x1p235,  0x1p267,  0x1p299, 0x1p331, 0x1p363};
    return (double)high * units[bin + 1] + (double)low * units[bin];
}

double rt_film_sum(const rt_film_pixel *pixel, int channel)
{
    return sum_of(pixel->high[channel], pixel->low[channel], film_bin(pixel->bins, channel));
}

double rt_first_hits_sum(const rt_first_hits *hits, int channel)
{
    return sum_of(hits->high[channel], hits->low[channel], film_bin(hits->bins, channel));
}

double rt_film_divisor(double weight, double count)
{
    return fabs(weight) >= 0.25 * count ? weight : count;
}

uint32_t rt_film_count(const rt_film *film, size_t i)
{
    uint32_t count = 0;
    for (uint32_t r = 0; r < film->units.replicates; r++)
        count += film->pixels[r * rt_film_pixels(film) + i].count;
    return count;
}

uint32_t rt_film_mean(float rgb[3], const rt_film *film, size_t i)
{
    double sum[3] = {0, 0, 0}, weight = 0, count = 0;
    uint32_t rejected = 0;
    for (uint32_t r = 0; r < film->units.replicates; r++) {
        const rt_film_pixel *p = film->pixels + r * rt_film_pixels(film) + i;
        for (int c = 0; c < 3; c++)
            sum[c] += rt_film_sum(p, c);
        weight += p->weight;
        count += p->count;
        rejected += p->bins >> RT_FILM_REJECTED;
    }
    for (int c = 0; c < 3; c++)
        rgb[c] = count > 0 ? (float)(sum[c] / rt_film_divisor(weight, count)) : 0;
    return rejected;
}

void rt_film_make_means(rt_film *film)
{
    film->is_resolved = 1;
    uint32_t fewest = rt_film_count(film, 0);
    film->stats.rejected = 0;
    for (size_t i = 0; i < rt_film_pixels(film); i++) {
        film->stats.rejected += rt_film_mean(film->rgb + 3 * i, film, i);
        const uint32_t count = rt_film_count(film, i);
        fewest = count < fewest ? count : fewest;
    }
    film->stats.spp = fewest;
    if (film->units.pilot > 0)
        film->stats.spp =
            (uint32_t)(film->units.base +
                       rt_units_samples_before(&film->units, rt_coverage_prefix(&film->done)));
}

const float *rt_film_rgb(const rt_film *film)
{
    return film->is_resolved ? film->rgb : NULL;
}

const float *rt_film_layer(const rt_film *film, const char *name, uint32_t *channels)
{
    for (int i = 0; i < RT_FILM_LAYER_COUNT; i++)
        if (film->layers.data[i] && strcmp(name, rt_layer_infos[i].name) == 0) {
            if (channels)
                *channels = rt_layer_infos[i].channels;
            return film->layers.data[i];
        }
    return NULL;
}

const char *rt_film_layer_name(const rt_film *film, size_t index)
{
    for (int i = 0; i < RT_FILM_LAYER_COUNT; i++)
        if (film->layers.data[i] && index-- == 0)
            return rt_layer_infos[i].name;
    return NULL;
}

void rt_film_get_size(const rt_film *film, uint32_t *width, uint32_t *height)
{
    *width = film->options.width;
    *height = film->options.height;
}

void rt_film_get_stats(const rt_film *film, rt_film_stats *out)
{
    *out = film->stats;
}

size_t rt_film_get_ledger(const rt_film *film, rt_light_ledger *out, size_t capacity)
{
    for (size_t i = 0; i < film->ledger.count && i < capacity; i++)
        rt_ledger_read(&film->ledger, i, out + i);
    return film->ledger.count;
}
