/*
 * work_folder.h - the folder in which a driver compiles: one of this process alone, so that no
 * other's damage, clean-up or full disk reaches the kernels that run here.
 */
#ifndef RT_LIB_DEVICE_WORK_FOLDER_H
#define RT_LIB_DEVICE_WORK_FOLDER_H

#include "rt.h"

enum { RT_PATH_MAX = 4096 };

/* Makes a folder and those above it. Returns 0 also where it is there already, or the errno. */
int rt_folder_make(const char *path);

/* Removes a folder and what it holds, as far as that can be removed; links are not followed. */
void rt_folder_remove(const char *path);

/*
 * Makes a work folder in `first` (may be empty), in TMPDIR, or in the usual temporary folders: the
 * first that has room for what a compiler writes and from which code can be loaded. Work folders
 * that killed processes left there are removed. It is removed when the process ends. Fails with
 * RT_ERROR_DEVICE, naming what is wrong with each.
 */
rt_status rt_work_folder_make(char path[RT_PATH_MAX], const char *first, rt_error *error);

#endif
