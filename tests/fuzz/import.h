/* import.h - what the targets of imported scenes share. */
#ifndef RT_TESTS_FUZZ_IMPORT_H
#define RT_TESTS_FUZZ_IMPORT_H

#include "fuzz/fuzz.h"
#include "dsl/import/import.h"

/*
 * Imports the bytes as a file of this name, without writing meshes or images; `read` is the reader.
 * Checks that there is a message or a scene, which is laid out. Returns whether there is a scene.
 */
int fuzz_import_run(const char *name, const uint8_t *data, size_t size,
                    void (*read)(importer *import, const char *bytes, size_t size));

/* Files that scenes may name: a.obj with a.mtl, a.ply, a.png. */
void fuzz_import_begin(void);

#endif
