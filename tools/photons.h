/* photons.h - the parts of `rtc photons`. Each says what goes wrong and returns the exit status. */
#ifndef RTC_PHOTONS_H
#define RTC_PHOTONS_H

#include "options.h"
#include "rt.h"

/* A form of the command that works on maps in files: the word that asks for it. */
typedef struct photons_form {
    const char *word;
    int (*run)(const command_line *arguments);
    int writes;        /* takes --out, and else, printing results, --json */
    int finds;         /* takes the settings by which photons are found around points */
    const char *usage; /* the start of its help */
} photons_form;

/* All forms; static storage. count may be NULL. */
const photons_form *photons_forms(size_t *count);

/* The form that a command line names, or NULL. */
const photons_form *photons_find_form(const command_line *arguments);

/* The word of the form that a word is like, or NULL. */
const char *photons_nearest_form(const char *word);

/* Whether a form has this option. */
int photons_form_takes(const photons_form *form, option_id id);

/* Whether a form, or NULL: emission, has this setting. */
int photons_form_takes_setting(const photons_form *form, const rt_setting *setting);

/* `rtc photons illuminance MAP POINTS`: prints what arrives at points. */
int photons_illuminance(const command_line *arguments);

/* `rtc photons SCENE`: emits a map. */
int photons_emit(const command_line *arguments);

/* Loads the map at path; says why when that fails. The caller owns *out. */
int photons_load(rt_photon_map **out, const char *path, const command_line *arguments);

/* The one file of --out, which has this extension. */
int photons_output(const char **out, const command_line *arguments, const char *what,
                   const char *extension);

/* Prints what a map holds on stdout, as lines or as JSON. */
int photons_print_info(const char *path, const rt_photon_map *map);
int photons_print_info_json(const char *path, const rt_photon_map *map, const command_line *timed);

/* Prints how two maps differ; *differ is whether they do. */
int photons_print_difference(const rt_photon_map *a, const rt_photon_map *b, int *differ);
int photons_print_difference_json(const char *const paths[2], const rt_photon_map *a,
                                  const rt_photon_map *b, int *differ);

/* What a list of photons adds up to. */
typedef struct photon_totals {
    double flux[3]; /* W */
    double lo[3], hi[3];
    uint64_t caustic, segments;
} photon_totals;
photon_totals photons_add_up(const rt_photon_map *map, rt_photon_kind kind);

/*
 * Photons that both lists have and those of one alone; a photon is known by seed, path and segment.
 */
typedef struct photon_matches {
    uint64_t equal, changed, only_a, only_b;
} photon_matches;
photon_matches photons_match(const rt_photon_map *a, const rt_photon_map *b, rt_photon_kind kind);

/* Whether the lists are made of the same paths. */
int photons_have_same_paths(const rt_photon_map *a, const rt_photon_map *b, rt_photon_kind kind);

#endif
