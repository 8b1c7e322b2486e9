/*
 * options.h - a command line and its options. Some are settings of a render, whose table is that of
 * rt/setting.h (see settings.h); the table of all others is options.c. The parser and the help
 * read the same tables.
 */
#ifndef RTC_OPTIONS_H
#define RTC_OPTIONS_H

#include <stddef.h>
#include <stdint.h>

#include "file_lock.h"
#include "rt.h"

typedef enum command_id {
    COMMAND_RENDER,
    COMMAND_CHECK,
    COMMAND_MESH,
    COMMAND_DEVICES,
    COMMAND_DOCTOR,
    COMMAND_KERNELS,
    COMMAND_STUDY,
    COMMAND_PATHS,
    COMMAND_FMT,
    COMMAND_IMPORT,
    COMMAND_PHOTONS,
    COMMAND_COMPARE,
    COMMAND_MERGE,
    COMMAND_INFO,
    COMMAND_COUNT
} command_id;

/* The options that are no settings, in the order of their table and of the help. */
typedef enum option_id {
    OPTION_SET,
    OPTION_CAMERA,
    OPTION_STRICT,
    OPTION_ACCEL,
    OPTION_PHOTON_MAP,
    OPTION_LIGHT_SHARES,
    OPTION_CHECKPOINT,
    OPTION_EVERY,
    OPTION_RESUME,
    OPTION_PART,
    OPTION_INCOMPLETE,
    OPTION_OUT,
    OPTION_SWEEP,
    OPTION_LIST,
    OPTION_ONLY,
    OPTION_QUICK,
    OPTION_REFERENCE,
    OPTION_REFERENCE_ERROR,
    OPTION_EQUAL,
    OPTION_REPEAT,
    OPTION_PIXEL,
    OPTION_SAMPLE,
    OPTION_DENOISE,
    OPTION_DENOISER,
    OPTION_EXPOSURE,
    OPTION_TONEMAP,
    OPTION_PREVIEW,
    OPTION_WATCH,
    OPTION_TRIANGLES,
    OPTION_MESH_OUT,
    OPTION_DUMP,
    OPTION_FMT_CHECK,
    OPTION_IMPORT_OUT,
    OPTION_LAYER,
    OPTION_BLOCK,
    OPTION_TOLERANCE,
    OPTION_COMPARE_EXPOSURE,
    OPTION_SCALE,
    OPTION_BLOCKS,
    OPTION_JSON,
    OPTION_MAX_MSE,
    OPTION_MAX_RMSE,
    OPTION_MAX_RELMSE,
    OPTION_MAX_BIAS,
    OPTION_MIN_SSIM,
    OPTION_MAX_FLIP,
    OPTION_MAX_OFF,
    OPTION_UNTRUSTED,
    OPTION_DEVICE,
    OPTION_THREADS,
    OPTION_WORK_GROUP,
    OPTION_MEMORY,
    OPTION_PROGRESS,
    OPTION_STATS,
    OPTION_COUNT_RAYS,
    OPTION_PROFILE,
    OPTION_VERBOSE,
    OPTION_QUIET,
    OPTION_HELP,
    OPTION_VERSION,
    OPTION_COUNT
} option_id;

typedef enum option_kind {
    KIND_FLAG,
    KIND_WHOLE,  /* a whole number, 1e6 allowed */
    KIND_REAL,   /* a finite number */
    KIND_SIZE,   /* bytes, from 1; 4G is 4 * 2^30 */
    KIND_CHOICE, /* one of a list of words */
    KIND_TEXT    /* any text that is not empty */
} option_kind;

/* What an option is for; the headings of the help. */
typedef enum option_group {
    GROUP_RENDER,
    GROUP_PHOTON,
    GROUP_KEEP,
    GROUP_OUTPUT,
    GROUP_STUDY,
    GROUP_PATHS,
    GROUP_MESH,
    GROUP_FMT,
    GROUP_IMPORT,
    GROUP_COMPARE,
    GROUP_LIMIT,
    GROUP_DEVICE,
    GROUP_TALK,
    GROUP_COUNT
} option_group;

typedef struct option {
    const char *name;  /* without the two dashes */
    const char *value; /* the value's name in the help; NULL for a flag */
    option_kind kind;
    option_group group;
    unsigned commands; /* bit 1 << command_id for each that takes it */
    double min, max;   /* KIND_WHOLE, KIND_REAL, KIND_SIZE; the library checks what is narrower */
    const rt_word *words; /* KIND_CHOICE */
    int decides_pixels;   /* of the picture or a layer: part of the command that it records */
    const char *fallback; /* the default, in words; NULL when there is none */
    const char *help;
} option;

extern const option option_table[OPTION_COUNT];
extern const char *const option_group_titles[GROUP_COUNT];

typedef enum progress_style {
    PROGRESS_AUTO,
    PROGRESS_PLAIN,
    PROGRESS_JSON,
    PROGRESS_NONE
} progress_style;

/* The value of an option; the member that its kind names is valid when given. */
typedef struct option_value {
    int given;
    uint64_t count; /* of KIND_WHOLE and KIND_SIZE */
    double real;
    int choice;
    const char *text; /* as written */
} option_value;

/* A parsed command line. The strings are those of argv. */
typedef struct command_line {
    command_id command;
    option_value options[OPTION_COUNT];
    const char **settings; /* what is given of each of rt_settings, as typed, or NULL */
    const char **outputs;  /* all values of --out */
    size_t output_count;
    rt_definition *definitions; /* of --set; the names are owned */
    size_t definition_count;
    const char **sweeps; /* all values of --sweep */
    size_t sweep_count;
    const char **operands;
    size_t operand_count;
    rt_memory *memory;       /* by --memory or --stats, or NULL; owned */
    rt_profile *profile;     /* by --stats or --profile, or NULL; owned */
    rt_film *film;           /* of --resume, or NULL; owned */
    char *note;              /* its text, which options point to; owned */
    char *paths;             /* those that film_place_enter made absolute; owned */
    file_lock lock;          /* of the checkpoint that is gone on with */
    const struct team *team; /* that this process is of, or NULL */
} command_line;

#endif
