/*
 * kernel_store.h - compiled programs between runs: what a driver wrote into the work folder for a
 * program, kept in one checked file.
 *
 * Drivers load what they find in their caches unchecked, and a damaged one ends the process. So
 * theirs is the work folder, empty at first, and what goes into it comes from here. A stored
 * program, with integers as this machine has them:
 *
 *     "RTKERN1\n", u64 key, u32 length and text of the folder, u32 files; for each file u32 length
 *     and text of its path in the folder, u32 length and bytes of its content; u32 CRC-32 of all
 *     before
 *
 * A stored program is replaced as a whole, by renaming, and keeps what others stored of it.
 */
#ifndef RT_LIB_DEVICE_KERNEL_STORE_H
#define RT_LIB_DEVICE_KERNEL_STORE_H

#include "rt.h"

enum { RT_STORED_FOLDER_MAX = 256 };

/* How the names of stored programs end. */
#define RT_STORED_SUFFIX ".kernels"

/*
 * Unpacks a stored program into the work folder and tells which folder in there is its own, a
 * relative path. RT_OK with an empty *folder where it is not stored. Fails where it is damaged, and
 * then removes it, or where it cannot be read or unpacked; then nothing of it is left in the work
 * folder.
 */
rt_status rt_stored_read(char folder[RT_STORED_FOLDER_MAX], size_t *files, const char *path,
                         uint64_t key, const char *work, rt_error *error);

/* Counts the files of a program's folder, those that a driver still writes aside. */
size_t rt_stored_count(const char *work, const char *folder);

/*
 * Stores the files of a program's folder that are not stored of it yet. Its folder keeps the name
 * under which it was stored first: drivers may give it another one in each process.
 */
rt_status rt_stored_write(const char *path, uint64_t key, const char *work, const char *folder,
                          rt_error *error);

/*
 * Removes stored programs that no run has read for 60 days, older builds of the library as a rule.
 */
void rt_stored_clean(const char *store);

#endif
