/* mesh.h - what the targets of mesh files share. */
#ifndef RT_TESTS_FUZZ_MESH_H
#define RT_TESTS_FUZZ_MESH_H

#include "fuzz/fuzz.h"

/*
 * Reads a file of this name and checks the mesh: indices in range, numbers finite, normals of unit
 * length, nothing changed where it is written as PLY and read again. An error has a place in the
 * file where has_lines says so.
 */
int fuzz_mesh_run(const char *name, const uint8_t *data, size_t size, int has_lines);

#endif
