/* ply_reader.h - the data of a PLY file, value by value, the same for ascii and binary. */
#ifndef RT_LIB_MESH_PLY_READER_H
#define RT_LIB_MESH_PLY_READER_H

#include "mesh/ply_header.h"

typedef struct rt_ply_reader {
    const rt_mesh_source *source;
    rt_ply_format format;
    rt_mesh_text text;       /* ascii: the place in the file */
    const uint8_t *at, *end; /* binary: the place in the file */

    /* What is being read, for messages. */
    const rt_ply_element *element;
    uint64_t row;
    const rt_ply_property *property;
} rt_ply_reader;

rt_ply_reader rt_ply_reader_begin(const rt_mesh_source *source, const rt_ply_header *header);

/* Whether a binary file has the byte order of this machine. */
int rt_ply_is_native(rt_ply_format format);

/* Reads a binary value; integers of up to 32 bits fit a double exactly. */
double rt_ply_decode(const uint8_t *at, rt_ply_type type, int native);

/* Fails at the value being read: "face 3, vertex_indices: ...". */
rt_status rt_ply_fail(const rt_ply_reader *reader, const char *format, ...) RT_PRINTF(2, 3);

/* The same of a value that is not finite, or is no colour, whose `largest` is as in colour.h. */
rt_status rt_ply_refuse(const rt_ply_reader *reader, double value, double largest);

/* Enters an element: its rows must fit in what is left of the file, however short they are. */
rt_status rt_ply_enter(rt_ply_reader *reader, const rt_ply_element *element);

/*
 * The next value. In ascii an integer must lie in the range of its type. May be infinite or not a
 * number.
 */
rt_status rt_ply_value(rt_ply_reader *reader, rt_ply_type type, double *out);

/* The same, finite as a float. */
rt_status rt_ply_finite(rt_ply_reader *reader, rt_ply_type type, float *out);

/* The length of the list that comes next; all its values fit in what is left of the file. */
rt_status rt_ply_list(rt_ply_reader *reader, const rt_ply_property *property, uint64_t *count);

/*
 * Passes over a scalar or a list. In ascii, the values skipped must still be numbers of their type.
 */
rt_status rt_ply_skip(rt_ply_reader *reader, const rt_ply_property *property);

/* Ends a row: in ascii nothing may be left on its line. */
rt_status rt_ply_end_row(rt_ply_reader *reader);

/*
 * Tells the log when the file goes on after the last row. Returns whether it does with more than
 * white space, which some programs end a binary file with.
 */
int rt_ply_end(rt_ply_reader *reader);

#endif
