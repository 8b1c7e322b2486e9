/*
 * board.h - what a render shows: its pictures, how far it is and what was said of it. The render
 * writes, and viewers (the page's server, the sender to tev) read, each on a thread of its own.
 */
#ifndef RTC_PREVIEW_BOARD_H
#define RTC_PREVIEW_BOARD_H

#include <pthread.h>
#include <stddef.h>
#include <stdint.h>

#include "rt.h"

/* The picture and its layers at most, messages that are kept, and the longest of these. */
enum { BOARD_LAYERS = 32, BOARD_MESSAGES = 40, BOARD_TEXT = 1024 };

/* Some channels of a picture; never changed, and freed when nobody holds it. */
typedef struct board_picture {
    rt_memory *memory; /* that it counts in; NULL: none */
    unsigned holders;
    uint64_t number; /* counted up over all pictures of a run */
    uint32_t width, height, channels;
    size_t bytes;
    float *values; /* [height][width][channels], linear, top row first */
} board_picture;

typedef enum board_phase {
    BOARD_LOADING,
    BOARD_RENDERING,
    BOARD_WAITING, /* for a change of a file */
    BOARD_FINISHED,
    BOARD_STOPPED,
    BOARD_FAILED
} board_phase;

typedef struct board_message {
    const char *severity; /* static */
    char text[BOARD_TEXT];
} board_message;

typedef struct board_layer {
    char name[32]; /* "": the picture itself */
    int is_wanted;
    int is_fresh; /* nobody has taken it since it was put */
    board_picture *picture;
} board_layer;

typedef struct board {
    pthread_mutex_t lock;
    pthread_cond_t changed;
    void (*wake)(void *user); /* called with the lock, after each change; or NULL */
    void *wake_user;
    uint64_t version;         /* of all below */
    uint64_t message_version; /* of the messages */
    uint64_t pictures;        /* so far */
    board_phase phase;
    int is_coarse;      /* the picture is a small one, enlarged */
    int is_watched;     /* files are watched, and the phase can go back */
    int is_closing;     /* viewers are to end */
    unsigned viewers;   /* that look now, */
    unsigned satisfied; /* and those of them that have the last picture */
    uint32_t renders;   /* begun */
    rt_progress progress;
    board_layer layers[BOARD_LAYERS];
    size_t layer_count;
    board_message messages[BOARD_MESSAGES];
    size_t message_count, message_first;
    char title[256];
} board;

void board_begin(board *out, const char *title);
void board_free(board *board);

/* ---- The render writes ----------------------------------------------------------------------- */

void board_set_phase(board *board, board_phase phase);
void board_set_progress(board *board, const rt_progress *progress);

/* Begins another render: pictures stay until others come. */
void board_begin_render(board *board, int is_coarse);

/* Takes all messages away. */
void board_clear_messages(board *board);

/* Adds a message; the oldest one makes room. */
void board_say(board *board, const char *severity, const char *text);

/* Makes the list of layers that of a film. Those that are no longer there are dropped. */
void board_set_layers(board *board, const rt_film *film);

/* Whether somebody looks and has taken what was put there last. */
int board_is_awaited(board *board);

/*
 * Puts what a film shows there: the layers that are wanted, or all. scale: each pixel becomes scale
 * x scale, cut to width x height. Where there is no memory the picture before stays. Returns
 * whether there was.
 */
int board_put_film(board *board, const rt_film *film, rt_memory *memory, int all, uint32_t scale,
                   uint32_t width, uint32_t height);

/*
 * Waits until all viewers have the last picture, but no longer than so many seconds; from then on
 * they are to end.
 */
void board_close(board *board, double patience);

/* ---- Viewers read ---------------------------------------------------------------------------- */

/* The newest picture of a layer, to be given back, or NULL; from now on it is wanted. */
board_picture *board_take(board *board, const char *layer);
void board_give(board_picture *picture);

/* Whether the command ends, and no other picture comes. Called with the lock. */
int board_is_over(const board *board);

/*
 * The state as a JSON object, to be freed; the messages are left out where these are those of
 * *message_version, which is set. Called with the lock. NULL without memory.
 */
char *board_json(const board *board, uint64_t *message_version);

#endif
