/* unit_part.h - the units of one part of a picture: those in every so manyth chunk. */
#ifndef RT_LIB_FILM_UNIT_PART_H
#define RT_LIB_FILM_UNIT_PART_H

#include "film/units.h"

/* Part `part` of `parts`, from 1: the chunks part - 1, part - 1 + parts and so on. */
typedef struct rt_unit_part {
    rt_units units;
    uint64_t first, step; /* of its chunks */
    uint64_t chunk;       /* units of a chunk, but for the last of a block */
    uint64_t in_block;    /* chunks of a block */
    /* Blocks, from 1, whose last chunk is the part's: every last_step from first_last; 0: none. */
    uint64_t first_last, last_step;
} rt_unit_part;

rt_unit_part rt_unit_part_of(const rt_units *units, uint32_t part, uint32_t parts);

/* How many units before this one are the part's; in a time that does not grow with the picture. */
uint64_t rt_unit_part_before(const rt_unit_part *part, uint64_t unit);

#endif
