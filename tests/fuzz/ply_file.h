/* ply_file.h - PLY files of random elements and properties. */
#ifndef RT_TESTS_FUZZ_PLY_FILE_H
#define RT_TESTS_FUZZ_PLY_FILE_H

#include "fuzz/fuzz.h"

/*
 * Appends a file of any format: vertices, faces, strips and others in any order, with properties of
 * any type, and a body that fits the header; now and then an index or a number is wrong.
 */
void fuzz_ply_file(rt_bytes *out, fuzz_random *random);

#endif
