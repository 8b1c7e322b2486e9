/* areas.c - the arrays of a film that go into its file. */
#include "film/areas.h"

#include "camera/film_sum.h"

#define MEMBER(type, name, number, count)                                                          \
    {                                                                                              \
        offsetof(type, name), RT_NUMBER_##number, count                                            \
    }
#define TABLE(type, members)                                                                       \
    {                                                                                              \
        sizeof(type), members, sizeof members / sizeof *members                                    \
    }

static const rt_member pixel_members[] = {
    MEMBER(rt_film_pixel, high, 64, 3),   MEMBER(rt_film_pixel, low, 64, 3),
    MEMBER(rt_film_pixel, bins, U32, 1),  MEMBER(rt_film_pixel, weight, I32, 1),
    MEMBER(rt_film_pixel, count, U32, 1), MEMBER(rt_film_pixel, cut_off, U32, 1),
};

static const rt_member hit_members[] = {
    MEMBER(rt_first_hits, albedo, 64, 3),
    MEMBER(rt_first_hits, normal, 64, 3),
    MEMBER(rt_first_hits, high, 64, RT_HIT_CHANNELS),
    MEMBER(rt_first_hits, low, 64, RT_HIT_CHANNELS),
    MEMBER(rt_first_hits, bins, U32, 1),
    MEMBER(rt_first_hits, rejected, U32, 1),
    MEMBER(rt_first_hits, count, U32, 1),
    MEMBER(rt_first_hits, weight, I32, 1),
    MEMBER(rt_first_hits, hits, U32, 1),
    MEMBER(rt_first_hits, hit_weight, I32, 1),
    MEMBER(rt_first_hits, first, 64, 1),
    MEMBER(rt_first_hits, shape, U32, 1),
    MEMBER(rt_first_hits, material, U32, 1),
};

/* rt_exact_sum is high, low and bin. */
static const rt_member photon_members[] = {
    MEMBER(rt_photon_sums, asked, 64, 1),   MEMBER(rt_photon_sums, photons, 64, 1),
    MEMBER(rt_photon_sums, samples, 64, 1), MEMBER(rt_photon_sums, radius, 64, 3),
    MEMBER(rt_photon_sums, density, 64, 3), MEMBER(rt_photon_sums, value, 64, 3),
    MEMBER(rt_photon_sums, square, 64, 3),  MEMBER(rt_photon_sums, bias, 64, 3),
};

static const rt_member rate_members[] = {{0, RT_NUMBER_U32, 1}};

static const rt_table pixel_table = TABLE(rt_film_pixel, pixel_members),
                      hit_table = TABLE(rt_first_hits, hit_members),
                      photon_table = TABLE(rt_photon_sums, photon_members),
                      rate_table = TABLE(rt_u32, rate_members);

int rt_film_areas(rt_film_area out[RT_FILM_AREAS], const rt_film *film)
{
    const size_t pixels = rt_film_pixels(film), planes = pixels * film->units.replicates;
    int count = 0;
    out[count++] = (rt_film_area){RT_AREA_PIXELS, &pixel_table, film->pixels, 0, planes};
    if (film->first_hits)
        out[count++] =
            (rt_film_area){RT_AREA_FIRST_HITS, &hit_table, film->first_hits, planes, pixels};
    if (film->photon_sums) {
        const size_t first = out[count - 1].first + out[count - 1].count;
        out[count++] =
            (rt_film_area){RT_AREA_PHOTON_SUMS, &photon_table, film->photon_sums, first, pixels};
    }
    if (film->moments) {
        const size_t first = out[count - 1].first + out[count - 1].count;
        out[count++] = (rt_film_area){RT_AREA_MOMENTS, &pixel_table, film->moments, first,
                                      RT_MOMENTS * pixels};
    }
    if (film->rates) {
        const size_t first = out[count - 1].first + out[count - 1].count;
        out[count++] = (rt_film_area){RT_AREA_RATES, &rate_table, film->rates, first, pixels};
    }
    return count;
}

int rt_area_has_samples(const rt_film_area *area, size_t row)
{
    const rt_film_pixel *pixel;
    const rt_first_hits *hits;
    const rt_photon_sums *sums;
    switch (area->kind) {
    case RT_AREA_PIXELS:
    case RT_AREA_MOMENTS:
        pixel = (const rt_film_pixel *)area->rows + row;
        return pixel->count > 0 || pixel->bins != 0;
    case RT_AREA_FIRST_HITS:
        hits = (const rt_first_hits *)area->rows + row;
        return hits->count > 0 || hits->rejected > 0;
    case RT_AREA_PHOTON_SUMS:
        sums = (const rt_photon_sums *)area->rows + row;
        return sums->samples > 0 || sums->asked > 0;
    case RT_AREA_RATES:
        return ((const rt_u32 *)area->rows)[row] > 0;
    }
    return 0;
}

/* Whether these can be the lower bins of so many channels. */
static int has_sound_bins(uint32_t bins, int channels)
{
    for (int c = 0; c < channels; c++)
        if (film_bin(bins, c) > RT_FILM_BIN_LAST)
            return 0;
    return 1;
}

/* Whether so many samples can have this sum of weights, of 1 or -1 each. */
static int is_sound_weight(int32_t weight, uint32_t count)
{
    return weight >= -(int64_t)count && weight <= (int64_t)count;
}

static int are_sound_sums(const rt_photon_sums *sums)
{
    const rt_exact_sum all[] = {sums->radius, sums->density, sums->value, sums->square, sums->bias};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (all[i].bin < 0 || all[i].bin > RT_EXACT_SUM_BIN_LAST)
            return 0;
    return 1;
}

int rt_area_is_sound(const rt_film_area *area, size_t row, size_t count)
{
    int sound = 1;
    for (; count > 0; count--, row++) {
        const rt_film_pixel *pixel = (const rt_film_pixel *)area->rows + row;
        const rt_first_hits *hits = (const rt_first_hits *)area->rows + row;
        switch (area->kind) {
        case RT_AREA_PIXELS:
        case RT_AREA_MOMENTS:
            sound &= has_sound_bins(pixel->bins, 3) && is_sound_weight(pixel->weight, pixel->count);
            break;
        case RT_AREA_FIRST_HITS:
            sound &= has_sound_bins(hits->bins, RT_HIT_CHANNELS) && hits->hits <= hits->count &&
                     is_sound_weight(hits->weight, hits->count) &&
                     is_sound_weight(hits->hit_weight, hits->hits) && hits->first >= 0 &&
                     hits->first <= INT64_MAX / 2;
            break;
        case RT_AREA_PHOTON_SUMS:
            sound &= are_sound_sums((const rt_photon_sums *)area->rows + row);
            break;
        case RT_AREA_RATES:
            sound &= ((const rt_u32 *)area->rows)[row] <= RT_RATE_MOST;
            break;
        }
    }
    return sound;
}
