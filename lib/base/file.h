/* file.h - whole files: read at once, and replaced at once. */
#ifndef RT_LIB_BASE_FILE_H
#define RT_LIB_BASE_FILE_H

#include "base/bytes.h"

/*
 * Reads a whole file. Fails with RT_ERROR_INPUT, naming path and cause, when it cannot be read
 * or holds more than limit bytes. The caller frees *out; it is written only on success.
 */
rt_status rt_file_read(rt_bytes *out, const char *path, size_t limit, rt_error *error);

/*
 * Whether what is at path, if there is anything, is a regular file: for names that stand in other
 * files. A pipe or a device might never end, and a pipe that none writes to not even open. Fails
 * with RT_ERROR_INPUT.
 */
rt_status rt_file_check_regular(const char *path, rt_error *error);

/* What the first `size` bytes of a file say of the size of the whole. */
typedef rt_status rt_file_size(uint64_t *out, const uint8_t *start, size_t size, const char *path,
                               rt_error *error);

/*
 * The same for a file whose first `start` bytes tell its size: what is no such file is not read to
 * its end, which may be far. The file is opened once and read on, so that it may be a pipe.
 */
rt_status rt_file_read_told(rt_bytes *out, const char *path, size_t start, rt_file_size *tell,
                            rt_error *error);

/*
 * Makes path hold exactly these bytes, or leaves it as it was: they go to a temporary file in the
 * same directory, are synchronised to the disk, and the file is renamed. A new file has the
 * permissions that open() gives (0666 less the umask), a replaced one keeps its own; a symbolic
 * link stays and its target is replaced, or made where there is none. What is not a regular file (a
 * device, a pipe) is written in place. Fails with RT_ERROR_OUTPUT, naming path and cause; the
 * temporary file is then gone.
 */
rt_status rt_file_replace(const char *path, const rt_bytes *bytes, rt_error *error);

#endif
