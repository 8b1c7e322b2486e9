/* photons.h - the parts of `rtc photons`. Each says what goes wrong and returns the exit status. */
#ifndef RTC_PHOTONS_H
#define RTC_PHOTONS_H

#include "rtc.h"
#include "rt.h"

/* `rtc photons SCENE`: emits a map. */
int photons_emit(const command_line *arguments);

/* Loads the map at path; says why when that fails. The caller owns *out. */
int photons_load(rt_photon_map **out, const char *path);

/* The one file of --out, which has this extension. */
int photons_output(const char **out, const command_line *arguments, const char *what, const char *extension);

/* Prints what a map holds on stdout. */
int photons_print_info(const char *path, const rt_photon_map *map);

/* Prints how two maps differ; *differ is whether they do. */
int photons_print_difference(const rt_photon_map *a, const rt_photon_map *b, int *differ);

#endif
