/* photons.h - the parts of `rtc photons`. Each says what goes wrong and returns the exit status. */
#ifndef RTC_PHOTONS_H
#define RTC_PHOTONS_H

#include "rtc.h"
#include "rt.h"

/* A form of the command that works on maps in files: the word that asks for it. */
typedef struct photons_form {
    const char *word;
    int (*run)(const command_line *arguments);
    int writes;        /* takes --out */
    const char *usage; /* the start of its help */
} photons_form;

/* The form that a command line names, or NULL. */
const photons_form *photons_find_form(const command_line *arguments);

/* Whether a form has this option. */
int photons_form_takes(const photons_form *form, option_id id);

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
