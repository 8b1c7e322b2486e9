/*
 * file_lock.h - one process at a time writes a checkpoint.
 *
 * The lock is a record lock on FILE.rtlock beside the file, and not on the file itself, whose place
 * a new one takes at each checkpoint. The kernel drops it when the process ends, however it ends,
 * and tells who has it; a process that ends in order removes FILE.rtlock, and what a killed one
 * left is taken over. A file of that name that holds something is not ours: it stays, and nothing
 * is locked.
 */
#ifndef RTC_FILE_LOCK_H
#define RTC_FILE_LOCK_H

/* All zero is none. */
typedef struct file_lock {
    int is_held, fd;
    char *path; /* of FILE.rtlock */
} file_lock;

/*
 * Takes the lock of a file, which need not be there. Returns 0, also where the file system has no
 * locks or the folder cannot be written, which is for others to tell. Otherwise another process has
 * it: returns its number, or -1 where that is not known here.
 */
long file_lock_take(file_lock *out, const char *path);

/* Gives it back; may be called for none. */
void file_lock_release(file_lock *lock);

/* Says that another process, of this number or -1, writes a checkpoint; returns an exit status. */
int file_lock_fail(const char *path, long process);

#endif
