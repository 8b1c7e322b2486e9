/* cell.h - the pictures of a study: each rendered, or taken from the folder that keeps them. */
#ifndef RTC_STUDY_CELL_H
#define RTC_STUDY_CELL_H

#include "../session.h"
#include "sweep.h"

/* The scene of the latest picture, ready on the device. All zero: none. */
typedef struct study_scene {
    char *key; /* its path, constants and structure; NULL: none */
    rt_scene *scene;
    rt_renderer *renderer;
} study_scene;

typedef struct study_renderer {
    session *session; /* its arguments are those of each picture in turn */
    rt_device *device;
    study_scene ready;
    char *folder;      /* where films are kept, with its slash */
    const char *study; /* its name, which begins those of its films; "" */
    size_t rendered;   /* pictures, and not taken from there */
    int is_checked;    /* scenes were read before, and have told their warnings */
} study_renderer;

/* What makes one picture: the command line with its values put in, and the scene's path. */
typedef struct study_picture {
    command_line line; /* a copy, whose arrays are its own; see study_picture_free */
    const char *scene;
    uint32_t repeat; /* its seed is so much larger */
    char *label;     /* "k=50,kernel=box" */
    char *file;      /* the name of its film, without its ending */
    int is_shared;   /* among the studies of a list */
} study_picture;

/* A name and the values of a combination, "reference,k=50,kernel=box"; to be freed. */
char *study_label(const sweep *sweep, size_t cell, const char *name);

/*
 * A combination of a sweep; its label begins with a name, which may be "". Returns an exit status;
 * free in either case.
 */
int study_picture_make(study_picture *out, const command_line *arguments, const sweep *sweep,
                       size_t cell, const char *scene, const char *name);
void study_picture_free(study_picture *picture);

/* Lets all studies share its film, whose name then tells its scene, constants and size. */
int study_picture_share(study_picture *picture);

/* Sets a setting of a picture, by its name in the language; text must outlive it. */
void study_picture_set(study_picture *picture, const char *setting, const char *text);

/*
 * The options of a picture, for which its scene is read. Returns an exit status, that of a usage
 * error where they cannot be.
 */
int study_read_options(rt_render_options *out, study_renderer *renderer,
                       const study_picture *picture);

/* The same, and its scene ready in renderer->ready. */
int study_prepare(rt_render_options *out, study_renderer *renderer, const study_picture *picture);

/*
 * Renders it, or takes it from the folder where the same picture stands, and keeps it there.
 * Returns an exit status; the caller owns *out.
 */
int study_render(rt_film **out, study_renderer *renderer, const study_picture *picture);

void study_renderer_free(study_renderer *renderer);

#endif
