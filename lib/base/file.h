/* file.h - whole files: read at once, and replaced at once. */
#ifndef RT_LIB_BASE_FILE_H
#define RT_LIB_BASE_FILE_H

#include "base/bytes.h"

/*
 * Reads a whole file. Fails with RT_ERROR_INPUT, naming path and cause, when it cannot be read
 * or holds more than limit bytes. The caller frees *out; it is empty before, counts in out->memory
 * and is written only on success.
 */
rt_status rt_file_read(rt_bytes *out, const char *path, size_t limit, rt_error *error);

/*
 * Fails with RT_ERROR_INPUT when path is there but no regular file, for names that stand in other
 * files: a device may never end, and opening a pipe without a writer blocks.
 */
rt_status rt_file_check_regular(const char *path, rt_error *error);

/* Reads the size of a whole file from its header, the first `size` bytes. */
typedef rt_status rt_file_size(uint64_t *out, const uint8_t *header, size_t size, const char *path,
                               rt_error *error);

/*
 * The same for a file whose first `header` bytes hold its size: a file of another kind, which may
 * be long, is not read to its end. The file is opened once, so that it may be a pipe. Fails also
 * where the file goes on beyond that size, and, before it is read, where it does not fit into
 * memory together with so many copies, which the caller makes of it.
 */
rt_status rt_file_read_sized(rt_bytes *out, const char *path, size_t header, rt_file_size *size_of,
                             uint32_t copies, rt_error *error);

/*
 * The same from a pipe or socket that is open, called `name` in messages; what follows is left in
 * it.
 */
rt_status rt_file_read_stream(rt_bytes *out, int fd, const char *name, size_t header,
                              rt_file_size *size_of, rt_error *error);

/*
 * Makes path hold exactly these bytes, or leaves it as it was: they go to a temporary file in the
 * same directory, are synchronised to the disk, the file is renamed, and the directory synchronised
 * where its file system can. A new file has the permissions that open() gives (0666 less the
 * umask), a replaced one keeps its own; a symbolic link stays and its target is replaced, or made
 * where there is none. What is not a regular file (a device, a pipe) is written in place. Fails
 * with RT_ERROR_OUTPUT, naming path and cause; the temporary file is then gone. Where the directory
 * alone could not be synchronised, path holds the new bytes, which a loss of power may still take.
 * A temporary file that a killed process left is removed by the next write into that folder.
 */
rt_status rt_file_replace(const char *path, const rt_bytes *bytes, rt_error *error);

/* Writes the content of a file, by rt_file_put; returns 0, or the errno of what failed. */
typedef int rt_file_content(const void *user, int fd);
int rt_file_put(int fd, const void *data, size_t size);

/* The same as rt_file_replace for what is too large to be in memory at once. */
rt_status rt_file_replace_by(const char *path, rt_file_content *content, const void *user,
                             rt_error *error);

#endif
