/* file.h - whole files: read at once, and replaced at once. */
#ifndef RT_LIB_IMAGE_FILE_H
#define RT_LIB_IMAGE_FILE_H

#include "image/bytes.h"

/*
 * Reads a whole file. Fails with RT_ERROR_INPUT, naming path and cause, when it cannot be read
 * or holds more than limit bytes. The caller frees *out; it is written only on success.
 */
rt_status rt_file_read(rt_bytes *out, const char *path, size_t limit, rt_error *error);

/* Reads at most `most` bytes from the start of a file into out; *size is how many there were. Fails as above. */
rt_status rt_file_read_start(void *out, size_t most, size_t *size, const char *path, rt_error *error);

/*
 * Makes path hold exactly these bytes, or leaves it as it was: they go to a temporary file in the
 * same directory, are synchronised to the disk, and the file is renamed. A new file has the
 * permissions that open() gives (0666 less the umask), a replaced one keeps its own; a symbolic
 * link stays and its target is replaced, or made where there is none. What is not a regular file
 * (a device, a pipe) is written in place. Fails with RT_ERROR_OUTPUT, naming path and cause; the temporary file is then
 * gone.
 */
rt_status rt_file_replace(const char *path, const rt_bytes *bytes, rt_error *error);

#endif
