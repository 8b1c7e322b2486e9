/* preview.c - begins and ends what --preview asks for, and hands it the pictures of a render. */
#include "preview.h"

#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../interrupt.h"
#include "../message.h"
#include "../status.h"
#include "server.h"
#include "target.h"
#include "tev.h"

/* Seconds between two pictures, and those that the end of a render waits for viewers. */
static const double interval = 0.2, patience = 5;

struct preview {
    board board;
    preview_server *server;
    tev *tev;
    rt_memory *memory;
    uint32_t scale, width, height; /* of pictures as they are shown */
    int has_layers;                /* the board lists those of this render */
    int lacked_memory;             /* which was told */
};

extern char **environ;

/* Opens the page in a browser, which outlives this program. */
static void open_browser(const char *address)
{
    static char program[] = "xdg-open";
    char *copy = strdup(address), *arguments[] = {program, copy, NULL};
    posix_spawnattr_t how;
    posix_spawn_file_actions_t files;
    sigset_t none;
    pid_t child;
    sigemptyset(&none);
    posix_spawnattr_init(&how);
    posix_spawnattr_setflags(&how, POSIX_SPAWN_SETSIGMASK);
    posix_spawnattr_setsigmask(&how, &none);
    posix_spawn_file_actions_init(&files);
    for (int fd = 0; fd < 3; fd++)
        posix_spawn_file_actions_addopen(&files, fd, "/dev/null", fd == 0 ? 0 : 1, 0);
    if (!copy || posix_spawnp(&child, program, &files, &how, arguments, environ) != 0)
        message_warning("no browser was opened: xdg-open (Debian: xdg-utils) does not start");
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&how);
    free(copy);
}

static void hear(void *user, const char *severity, const char *text)
{
    preview *p = user;
    board_say(&p->board, severity, text);
}

static int open_page(preview *p, const preview_target *target)
{
    const char *why = server_open(&p->server, &p->board, target->port, interrupt_request);
    if (why && target->port > 0)
        message_error("--preview: port %u of 127.0.0.1: %s", target->port, why);
    else if (why)
        message_error("--preview: no page: %s", why);
    if (why)
        return STATUS_OUTPUT;
    message_note("preview at %s", server_address(p->server));
    if (target->opens)
        open_browser(server_address(p->server));
    return STATUS_DONE;
}

static int open_tev(preview *p, const preview_target *target)
{
    const char *why = tev_open(&p->tev, &p->board, target->host, target->port);
    if (!why)
        return STATUS_DONE;
    message_error("--preview: no tev at %s:%u: %s", target->host, target->port, why);
    message_hint("start tev first; it listens at 127.0.0.1:14158");
    return STATUS_OUTPUT;
}

int preview_open(preview **out, const command_line *arguments, const char *scene, int is_watched)
{
    const option_value *value = &arguments->options[OPTION_PREVIEW];
    preview_target target;
    *out = NULL;
    if (!value->given)
        return STATUS_DONE;
    if (!preview_target_read(&target, value->text)) {
        message_error("--preview takes page, open or tev, each with :PORT, or tev:HOST:PORT; not "
                      "'%s'",
                      value->text);
        return STATUS_USAGE;
    }
    if (arguments->options[OPTION_UNTRUSTED].given) {
        message_error("--preview does not go with --untrusted, which gives up the network");
        return STATUS_USAGE;
    }
    preview *p = calloc(1, sizeof *p);
    if (!p) {
        message_error("out of memory");
        return STATUS_DEVICE;
    }
    const char *slash = strrchr(scene, '/');
    board_begin(&p->board, slash ? slash + 1 : scene);
    p->board.is_watched = is_watched;
    p->memory = arguments->memory;
    const int status = target.is_tev ? open_tev(p, &target) : open_page(p, &target);
    if (status != STATUS_DONE) {
        board_free(&p->board);
        free(p);
        return status;
    }
    message_listen(hear, p);
    *out = p;
    return STATUS_DONE;
}

/* ---- Pictures ----------------------------------------------------------------------------- */

static void put(preview *p, const rt_film *film, int all)
{
    if (!p->has_layers)
        board_set_layers(&p->board, film);
    p->has_layers = 1;
    if (board_put_film(&p->board, film, p->memory, all, p->scale, p->width, p->height) ||
        p->lacked_memory)
        return;
    p->lacked_memory = 1;
    message_warning("no memory for the preview, and the render goes on");
}

static void on_preview(void *user, const rt_film *film)
{
    preview *p = user;
    if (board_is_awaited(&p->board))
        put(p, film, 0);
}

void preview_begin(preview *p, rt_render_options *options, uint32_t scale, uint32_t width,
                   uint32_t height)
{
    if (!p)
        return;
    options->preview = on_preview;
    options->preview_user = p;
    options->preview_seconds = interval;
    p->scale = scale;
    p->width = width;
    p->height = height;
    p->has_layers = 0;
    board_begin_render(&p->board, scale > 1);
}

void preview_show(preview *p, const rt_film *film)
{
    if (p && film)
        put(p, film, 1);
}

void preview_progress(preview *p, const rt_progress *progress)
{
    if (p)
        board_set_progress(&p->board, progress);
}

void preview_set_phase(preview *p, board_phase phase)
{
    if (p)
        board_set_phase(&p->board, phase);
}

void preview_clear_messages(preview *p)
{
    if (p)
        board_clear_messages(&p->board);
}

void preview_end(preview *p, int status)
{
    if (!p)
        return;
    board_set_phase(&p->board, status == STATUS_DONE          ? BOARD_FINISHED
                               : status == STATUS_INTERRUPTED ? BOARD_STOPPED
                                                              : BOARD_FAILED);
    message_listen(NULL, NULL);
    board_close(&p->board, patience);
    server_close(p->server);
    if (!tev_close(p->tev))
        message_warning("tev went away before it had the last picture");
    board_free(&p->board);
    free(p);
}
