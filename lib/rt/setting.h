/*
 * rt/setting.h - every setting of a render as data: one table from which the scene language, the
 * command line, the checks, the defaults and the reference page are made. Part of rt.h, the manual.
 */
#ifndef RT_RT_SETTING_H
#define RT_RT_SETTING_H

#include "field.h"
#include "render.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What a setting is about. */
typedef enum rt_setting_topic {
    RT_TOPIC_RENDER, /* how the picture is computed */
    RT_TOPIC_FILM,   /* its size and filter; stands in a `film` block, the others in `render` */
    RT_TOPIC_PHOTON, /* how photon mode emits and gathers */
    RT_TOPIC_LAYER   /* what is written beside the picture */
} rt_setting_topic;

#define RT_SETTING_EMITS 1u /* decides which photons are emitted */

typedef enum rt_test {
    RT_TEST_NONE,
    RT_TEST_IS,
    RT_TEST_IS_NOT,
    RT_TEST_ABOVE,
    RT_TEST_BELOW
} rt_test;

/* A condition on the value of a setting. RT_TEST_NONE: there is none. */
typedef struct rt_condition {
    const char *setting;
    rt_test test;
    double value;
} rt_condition;

#define RT_CONDITIONS_MAX 4

/* One thing that a setting needs to have an effect: any of some conditions. */
typedef struct rt_setting_need {
    rt_condition any[RT_CONDITIONS_MAX];
    const char *otherwise; /* goes on after "NAME has no effect"; settings stand in backquotes */
} rt_setting_need;

typedef struct rt_setting {
    rt_field field; /* name, type, range, ...; offset and size are those in rt_render_options */
    rt_setting_topic topic;
    unsigned flags;
    const rt_setting_need
        *needs; /* all are needed; ended by one whose otherwise is NULL, or NULL */
} rt_setting;

/* All settings, those of one topic together; static storage. */
RT_API const rt_setting *rt_settings(size_t *count);

/* The setting of a name, as the language or the command line writes it, max_depth or max-depth. */
RT_API const rt_setting *rt_setting_find(const char *name);

/*
 * Sets one from text: "16", "1e6", "all", "photon", "true". Fails with RT_ERROR_USAGE, error->field
 * naming the setting, when the text is not what it takes.
 */
RT_API rt_status rt_setting_set(rt_render_options *options, const rt_setting *setting,
                                const char *text, rt_error *error);

/* Its value as a text that rt_setting_set takes, but for the 0 of a default. Returns out. */
RT_API const char *rt_setting_get(char *out, size_t size, const rt_setting *setting,
                                  const rt_render_options *options);

/* Its value as a number: of a choice the enum, RT_K_ALL for all. */
RT_API double rt_setting_value(const rt_setting *setting, const rt_render_options *options);

/* "a whole number from 1 to 4096", "path, photon or direct": what it takes. Returns out. */
RT_API const char *rt_setting_phrase(char *out, size_t size, const rt_setting *setting);

/* Whether the options meet a need. */
RT_API int rt_setting_need_met(const rt_setting_need *need, const rt_render_options *options);

/* The first need that the options do not meet, so that the setting has no effect; or NULL. */
RT_API const rt_setting_need *rt_setting_missing(const rt_setting *setting,
                                                 const rt_render_options *options);

/* How text in backquotes, the name of a setting, is shown. */
typedef enum rt_name_style {
    RT_NAME_QUOTED, /* 'max_depth' */
    RT_NAME_OPTION  /* --max-depth */
} rt_name_style;

/* A text of the table, such as help, with the names in it in a style. Returns out. */
RT_API const char *rt_setting_text(char *out, size_t size, const char *text, rt_name_style style);

#ifdef __cplusplus
}
#endif

#endif
