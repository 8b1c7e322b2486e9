/* sweep.h - what a study varies: axes of values, of which it renders every combination. */
#ifndef RTC_STUDY_SWEEP_H
#define RTC_STUDY_SWEEP_H

#include <stddef.h>

#include "rt.h"

/* What an axis varies. */
typedef enum sweep_kind {
    SWEEP_SETTING, /* a setting of rt/setting.h */
    SWEEP_SCENE,   /* the scene's file */
    SWEEP_ACCEL,   /* rt_renderer_options.accel */
    SWEEP_CONSTANT /* of the scene, as --set does */
} sweep_kind;

typedef struct sweep_axis {
    sweep_kind kind;
    const rt_setting *setting; /* of SWEEP_SETTING */
    char *name;                /* as the page shows it */
    const char *constant;      /* of SWEEP_CONSTANT: its name, in `name` behind "let:" */
    char **values;             /* [count], as typed */
    size_t count;
} sweep_axis;

#define SWEEP_AXES 6

typedef struct sweep {
    sweep_axis axes[SWEEP_AXES];
    size_t count;
} sweep;

/*
 * Adds what `NAME=VALUE,VALUE,...` says, or NAME=all; let:NAME is a constant also where a setting
 * has that name. Returns an exit status.
 */
int sweep_add(sweep *sweep, const char *text);
void sweep_free(sweep *sweep);

/* How many combinations there are; the last axis varies fastest. */
size_t sweep_cells(const sweep *sweep);

/* Which value of an axis a combination has, and the value. */
size_t sweep_place(const sweep *sweep, size_t cell, size_t axis);
const char *sweep_value(const sweep *sweep, size_t cell, size_t axis);

/* Whether all values of an axis are numbers. */
int sweep_is_numeric(const sweep_axis *axis);

/* The axis of a kind, or NULL. */
const sweep_axis *sweep_find(const sweep *sweep, sweep_kind kind);

#endif
