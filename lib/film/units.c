/* units.c - which samples a unit of work stands for. */
#include "film/units.h"

/* Blocks of the modes whose samples are cheap; those of gathering are one sample. */
enum { longest_block = 32 };

int rt_rates_wanted(const rt_render_options *options)
{
    return options->sampling == RT_SAMPLING_ADAPTIVE &&
           (options->mode == RT_MODE_PATH || options->mode == RT_MODE_DIRECT);
}

int rt_noise_wanted(const rt_render_options *options)
{
    return options->variance || options->target_error > 0 || rt_rates_wanted(options);
}

int rt_error_bound_wanted(const rt_render_options *o)
{
    return rt_noise_wanted(o) && o->mode == RT_MODE_PHOTON;
}

uint32_t rt_replicate_grow(uint32_t length)
{
    int is_power_of_two = (length & (length - 1)) == 0;
    if (length < 2)
        return length + 1;
    return is_power_of_two ? length + length / 2 : length / 3 * 4;
}

uint32_t rt_units_next_test(uint32_t length)
{
    enum { PART = 8 };
    const uint32_t step = length / PART / longest_block * longest_block;
    if (length < 2 * longest_block)
        return rt_replicate_grow(length);
    return length + (step < longest_block ? longest_block : step);
}

/* Where block `index` of a sequence begins, in samples; `longest` is a power of two. */
static uint64_t block_begin(uint64_t index, uint32_t longest)
{
    uint64_t begin = 0;
    for (; index > 0; index--) {
        uint64_t next = rt_replicate_grow((uint32_t)begin);
        if (next - begin >= longest)
            return begin + index * longest;
        begin = next;
    }
    return begin;
}

/* The samples of a replicate, when all have so many together. */
static uint32_t share(uint32_t samples, uint32_t replicates, uint32_t replicate)
{
    return samples / replicates + (replicate < samples % replicates);
}

/* The blocks of a sequence of so many samples. */
static uint64_t block_count(uint32_t samples, uint32_t longest)
{
    uint64_t blocks = 0;
    for (uint32_t begin = 0; begin < samples; blocks++) {
        const uint32_t next = rt_replicate_grow(begin);
        if (next - begin >= longest)
            return blocks + ((uint64_t)samples - begin + longest - 1) / longest;
        begin = next;
    }
    return blocks;
}

/* As few sequences as tell what is asked for: units.h. */
static uint32_t replicates_of(const rt_render_options *o)
{
    const int is_sampled = o->mode == RT_MODE_PATH || o->mode == RT_MODE_DIRECT;
    if (!rt_noise_wanted(o))
        return 1;
    return is_sampled && !o->variance && (uint64_t)o->width * o->height >= RT_REPLICATES_FEW_PIXELS
               ? RT_REPLICATES_FEW
               : RT_REPLICATES;
}

rt_units rt_units_of(const rt_render_options *o, uint32_t base)
{
    int is_photon = o->mode == RT_MODE_PHOTON, is_vcm = o->mode == RT_MODE_VCM;
    rt_units units = {
        .in_passes = is_vcm || (is_photon && o->passes > 1),
        .replicates = replicates_of(o),
        .base = base,
        .longest = is_photon ? 1 : longest_block,
    };
    units.pilot = rt_rates_wanted(o) ? RT_PILOT_SAMPLES / units.replicates : 0;
    units.samples = units.in_passes && !is_vcm ? o->passes : o->spp;
    units.items = units.in_passes ? 1 : o->width * o->height;
    const uint64_t blocks =
        units.replicates * block_count(share(units.samples, units.replicates, 0), units.longest);
    units.count = units.in_passes ? units.samples : blocks * units.items;
    return units;
}

/* The blocks of a sequence of so many samples that are not cut short by its end. */
static uint64_t whole_blocks(uint32_t samples, uint32_t longest)
{
    const uint64_t blocks = block_count(samples, longest);
    return blocks - (block_begin(blocks, longest) > samples);
}

uint64_t rt_units_shared(const rt_units *units, uint32_t samples)
{
    const uint32_t both = samples < units->samples ? samples : units->samples;
    const uint64_t rounds =
        whole_blocks(share(both, units->replicates, units->replicates - 1), units->longest);
    uint64_t blocks = rounds * units->replicates;
    for (uint32_t r = 0; r < units->replicates; r++)
        blocks += whole_blocks(share(both, units->replicates, r), units->longest) > rounds;
    return blocks * units->items;
}

rt_sample_block rt_units_block(const rt_units *units, uint64_t unit)
{
    uint64_t block = unit / units->items;
    if (units->in_passes)
        return (rt_sample_block){(uint32_t)(block % units->replicates),
                                 (uint32_t)(block / units->replicates), 1};
    const uint32_t r = (uint32_t)(block % units->replicates);
    const uint64_t has = share(units->base, units->replicates, r),
                   all = share(units->samples, units->replicates, r);
    uint64_t begin = block_begin(block / units->replicates, units->longest),
             end = block_begin(block / units->replicates + 1, units->longest);
    begin = begin < has ? has : begin;
    end = end > all ? all : end;
    return (rt_sample_block){r, (uint32_t)begin, end > begin ? (uint32_t)(end - begin) : 0};
}

double rt_units_samples_before(const rt_units *units, uint64_t unit)
{
    if (units->in_passes)
        return (double)unit;
    uint64_t block = unit / units->items;
    const rt_sample_block now = rt_units_block(units, unit);
    double samples = (double)now.count * (double)(unit % units->items) / units->items;
    for (uint32_t r = 0; r < units->replicates; r++) {
        const uint64_t before = block / units->replicates + (r < now.replicate);
        const uint64_t has = share(units->base, units->replicates, r),
                       all = share(units->samples, units->replicates, r);
        const uint64_t end = block_begin(before, units->longest);
        samples += (double)((end > all ? all : end < has ? has : end) - has);
    }
    return samples;
}

double rt_units_amount(const rt_units *units, rt_unit_range range)
{
    return rt_units_samples_before(units, range.first + range.count) -
           rt_units_samples_before(units, range.first);
}

uint32_t rt_units_length(const rt_units *units, uint64_t unit)
{
    const uint64_t rounds = unit / units->items / units->replicates;
    if (rounds == 0)
        return units->base / units->replicates;
    const rt_sample_block last =
        rt_units_block(units, (rounds * units->replicates - 1) * units->items);
    return last.first + last.count;
}

/* The units of a chunk, but for the last of a block. */
static uint64_t chunk_items(const rt_units *units)
{
    const uint64_t part = (units->items + 63) / 64, least = 64;
    return part < least ? least : part > RT_CHUNK_ITEMS ? RT_CHUNK_ITEMS : part;
}

/* The chunks of a block. */
static uint64_t chunks_in_block(const rt_units *units)
{
    return (units->items + chunk_items(units) - 1) / chunk_items(units);
}

uint64_t rt_units_chunks(const rt_units *units)
{
    return units->count / units->items * chunks_in_block(units);
}

rt_unit_range rt_units_chunk(const rt_units *units, uint64_t chunk)
{
    const uint64_t in_block = chunks_in_block(units), items = chunk_items(units);
    const uint64_t item = chunk % in_block * items, left = units->items - item;
    return (rt_unit_range){chunk / in_block * units->items + item, left < items ? left : items};
}

uint64_t rt_units_chunk_of(const rt_units *units, uint64_t unit)
{
    return unit / units->items * chunks_in_block(units) + unit % units->items / chunk_items(units);
}
