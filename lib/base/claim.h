/*
 * claim.h - temporary files that belong to a live process, and those that a killed one left.
 *
 * A claim is a record lock on the file. The kernel drops it when the process ends, however it ends,
 * and keeps it apart for containers and over NFS, where process numbers say nothing. Names still
 * hold the process number: a process cannot see its own locks, and loses them by opening the file.
 */
#ifndef RT_LIB_BASE_CLAIM_H
#define RT_LIB_BASE_CLAIM_H

#include <stddef.h>

/*
 * Makes, opens for writing, and claims a new file "FOLDER PREFIX PID - NUMBER SUFFIX" with these
 * permissions; folder ends with a slash or is empty. The claim holds until *fd is closed; before
 * that the file is removed or renamed. Writes the file's path. Returns 0, or the errno of what
 * failed.
 */
int rt_claim_new(int *fd, char *path, size_t size, const char *folder, const char *prefix,
                 const char *suffix, unsigned permissions);

/*
 * Removes the files in a folder that another process of this user made by rt_claim_new, with the
 * same prefix and suffix, and ended without removing. Where `beside` is given, it is first called
 * for each, with the path less its suffix, to remove what belongs to it. What cannot be removed
 * stays.
 */
void rt_claim_clean(const char *folder, const char *prefix, const char *suffix,
                    void (*beside)(const char *path));

#endif
