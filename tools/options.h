/*
 * options.h - the command line as a table: one entry an option, read by the parser and by
 * the help, so that what is accepted and what is described cannot differ.
 */
#ifndef RTC_OPTIONS_H
#define RTC_OPTIONS_H

#include <stddef.h>
#include <stdint.h>

typedef enum command_id {
    COMMAND_RENDER,
    COMMAND_CHECK,
    COMMAND_MESH,
    COMMAND_DEVICES,
    COMMAND_DOCTOR,
    COMMAND_PHOTONS,
    COMMAND_COMPARE,
    COMMAND_COUNT
} command_id;

/* In the order of the table and of the help. */
typedef enum option_id {
    OPTION_MODE,
    OPTION_SPP,
    OPTION_MAX_DEPTH,
    OPTION_TIME,
    OPTION_ROULETTE_DEPTH,
    OPTION_ROULETTE_THRESHOLD,
    OPTION_TARGET_ERROR,
    OPTION_SEED,
    OPTION_SAMPLER,
    OPTION_FILTER,
    OPTION_ESTIMATOR,
    OPTION_ACCEL,
    OPTION_WIDTH,
    OPTION_HEIGHT,
    OPTION_PHOTONS,
    OPTION_K,
    OPTION_RADIUS,
    OPTION_GATHER,
    OPTION_PASSES,
    OPTION_ALPHA,
    OPTION_PHOTON_LAYERS,
    OPTION_KERNEL,
    OPTION_CONE_K,
    OPTION_AREA,
    OPTION_DIRECT,
    OPTION_FINAL_GATHER,
    OPTION_CAUSTIC_PHOTONS,
    OPTION_CAUSTIC_K,
    OPTION_CAUSTIC_RADIUS,
    OPTION_CAUSTIC_KERNEL,
    OPTION_PHOTON_MAP,
    OPTION_PART,
    OPTION_LIGHT_SHARES,
    OPTION_OUT,
    OPTION_AOV,
    OPTION_VARIANCE,
    OPTION_EXPOSURE,
    OPTION_TONEMAP,
    OPTION_TRIANGLES,
    OPTION_MESH_OUT,
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
    OPTION_DEVICE,
    OPTION_THREADS,
    OPTION_WORK_GROUP,
    OPTION_PROGRESS,
    OPTION_STATS,
    OPTION_VERBOSE,
    OPTION_QUIET,
    OPTION_HELP,
    OPTION_VERSION,
    OPTION_COUNT
} option_id;

typedef enum option_kind {
    KIND_FLAG,
    KIND_SWITCH, /* a flag that the scene may have set: --no-NAME takes it back; choice is 0 or 1 */
    KIND_WHOLE,  /* a whole number, 1e6 allowed */
    KIND_REAL,   /* a finite number */
    KIND_BETWEEN, /* one that is neither min nor max: 0 would mean the default to the library */
    KIND_CHOICE,  /* one of a list of words */
    KIND_TEXT     /* any text that is not empty */
} option_kind;

typedef struct option_choice {
    const char *word; /* NULL ends a list */
    int value;
} option_choice;

/* What an option is for; the headings of the help. */
typedef enum option_group {
    GROUP_RENDER,
    GROUP_PHOTON,
    GROUP_OUTPUT,
    GROUP_MESH,
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
    /* KIND_WHOLE, KIND_REAL, KIND_BETWEEN; the library checks what is narrower */
    double min, max;
    /* KIND_CHOICE; KIND_WHOLE: words that may stand for a number, or NULL */
    const option_choice *choices;
    int decides_pixels;   /* part of the command line recorded in an image */
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
    uint64_t count;
    double real;
    int choice;
    const char *text; /* as written */
} option_value;

/* A parsed command line. The strings are those of argv. */
typedef struct command_line {
    command_id command;
    option_value options[OPTION_COUNT];
    const char **outputs; /* all values of --out */
    size_t output_count;
    const char **operands;
    size_t operand_count;
} command_line;

/*
 * Parses argv[1] to argv[argc - 1]. Where an option is given twice, the last one counts; --out
 * adds up. Returns STATUS_DONE, or the exit status after saying what is wrong. Free *out with
 * arguments_free in either case.
 */
int arguments_parse(command_line *out, int argc, char **argv);
void arguments_free(command_line *arguments);

/* The name of a subcommand as typed; "" for COMMAND_RENDER. */
const char *command_name(command_id command);

/* "path, photon": the words of a list, as far as they fit in out. */
void option_join_choices(char *out, size_t size, const option_choice *choices);

/* Whether a value follows the option's name. */
int option_takes_value(const option *option);

/* Prints the help of a command, or of the form of it that is named, on stdout. */
void help_print(const command_line *arguments);

#endif
