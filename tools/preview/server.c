/* server.c - serves the page of a preview, its events and its pictures. */
#include "server.h"

#include <arpa/inet.h>
#include <errno.h>
#include <microhttpd.h>
#include <netinet/in.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "page_source.h"

/* Connections at most, seconds without a word after which one ends, and bytes of a request. */
enum { CONNECTIONS = 64, SILENT_SECONDS = 20, REQUEST_BYTES = 16384 };

/* A viewer's stream of events; suspended while there is nothing new. */
typedef struct stream {
    preview_server *server;
    struct MHD_Connection *connection;
    struct stream *next;
    uint64_t version, message_version; /* that it was told */
    int is_suspended;
    char *text; /* under way, or NULL */
    size_t size, sent;
} stream;

struct preview_server {
    board *board;
    struct MHD_Daemon *daemon;
    stream *streams;
    void (*stop)(void);
    unsigned port;
    char token[TOKEN_LENGTH + 1], nonce[TOKEN_LENGTH + 1];
    char address[SERVER_ADDRESS];
    char *page; /* page.html, with the nonce of this run */
    size_t page_size;
};

/* ---- Events --------------------------------------------------------------------- */

/* Lets all streams go on; called with the board's lock. */
static void wake(void *user)
{
    const preview_server *server = user;
    for (stream *s = server->streams; s; s = s->next) {
        if (s->is_suspended)
            MHD_resume_connection(s->connection);
        s->is_suspended = 0;
    }
}

/* The next event of a stream: the state of the board. */
static void compose(stream *s)
{
    char *state = board_json(s->server->board, &s->message_version);
    s->version = s->server->board->version;
    const size_t size = state ? strlen(state) + sizeof "data: \n\n" : 0;
    s->text = state ? malloc(size) : NULL;
    s->sent = s->size = 0;
    if (s->text)
        s->size = (size_t)snprintf(s->text, size, "data: %s\n\n", state);
    free(state);
}

static ssize_t read_stream(void *user, uint64_t position, char *out, size_t room)
{
    stream *s = user;
    board *b = s->server->board;
    ssize_t count = MHD_CONTENT_READER_END_OF_STREAM;
    (void)position;
    pthread_mutex_lock(&b->lock);
    if (!s->text && s->version != b->version)
        compose(s);
    if (s->text) {
        count = (ssize_t)(s->size - s->sent < room ? s->size - s->sent : room);
        memcpy(out, s->text + s->sent, (size_t)count);
        s->sent += (size_t)count;
        if (s->sent == s->size) {
            free(s->text);
            s->text = NULL;
        }
    } else if (!b->is_closing) {
        s->is_suspended = 1;
        MHD_suspend_connection(s->connection);
        count = 0;
    }
    pthread_mutex_unlock(&b->lock);
    return count;
}

static void end_stream(void *user)
{
    stream *s = user;
    board *b = s->server->board;
    pthread_mutex_lock(&b->lock);
    stream **at = &s->server->streams;
    while (*at && *at != s)
        at = &(*at)->next;
    if (*at)
        *at = s->next;
    b->viewers--;
    pthread_cond_broadcast(&b->changed);
    pthread_mutex_unlock(&b->lock);
    free(s->text);
    free(s);
}

static struct MHD_Response *events(preview_server *server, struct MHD_Connection *connection)
{
    enum { BLOCK = 4096 };
    board *b = server->board;
    stream *s = calloc(1, sizeof *s);
    struct MHD_Response *response =
        s ? MHD_create_response_from_callback(MHD_SIZE_UNKNOWN, BLOCK, read_stream, s, end_stream)
          : NULL;
    if (!response) {
        free(s);
        return NULL;
    }
    s->server = server;
    s->connection = connection;
    pthread_mutex_lock(&b->lock);
    s->next = server->streams;
    server->streams = s;
    b->viewers++;
    pthread_mutex_unlock(&b->lock);
    MHD_add_response_header(response, "Content-Type", "text/event-stream");
    return response;
}

/* ---- Pictures --------------------------------------------------------------------- */

static ssize_t read_picture(void *user, uint64_t position, char *out, size_t room)
{
    const board_picture *picture = user;
    const size_t left = picture->bytes - (size_t)position, count = left < room ? left : room;
    memcpy(out, (const char *)picture->values + position, count);
    return (ssize_t)count;
}

static void end_picture(void *user)
{
    board_give(user);
}

static void add_number(struct MHD_Response *response, const char *name, uint64_t value)
{
    char text[32];
    snprintf(text, sizeof text, "%llu", (unsigned long long)value);
    MHD_add_response_header(response, name, text);
}

/* A layer's values as they lie in memory, little-endian floats; 204 where it has none yet. */
static struct MHD_Response *picture(preview_server *server, struct MHD_Connection *connection,
                                    unsigned *status)
{
    enum { BLOCK = 1 << 18 };
    const char *layer = MHD_lookup_connection_value(connection, MHD_GET_ARGUMENT_KIND, "layer");
    board_picture *taken = board_take(server->board, layer ? layer : "");
    if (!taken) {
        *status = MHD_HTTP_NO_CONTENT;
        return MHD_create_response_from_buffer(0, "", MHD_RESPMEM_PERSISTENT);
    }
    struct MHD_Response *response =
        MHD_create_response_from_callback(taken->bytes, BLOCK, read_picture, taken, end_picture);
    if (!response) {
        board_give(taken);
        return NULL;
    }
    MHD_add_response_header(response, "Content-Type", "application/octet-stream");
    add_number(response, "X-Width", taken->width);
    add_number(response, "X-Height", taken->height);
    add_number(response, "X-Channels", taken->channels);
    add_number(response, "X-Number", taken->number);
    return response;
}

/* ---- Answers ------------------------------------------------------------------------ */

static void add_headers(const preview_server *server, struct MHD_Response *response)
{
    char policy[256];
    snprintf(policy, sizeof policy,
             "default-src 'none'; script-src 'nonce-%s'; style-src 'nonce-%s'; connect-src 'self'; "
             "img-src data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
             server->nonce, server->nonce);
    MHD_add_response_header(response, "Content-Security-Policy", policy);
    MHD_add_response_header(response, "Cache-Control", "no-store");
    MHD_add_response_header(response, "X-Content-Type-Options", "nosniff");
    MHD_add_response_header(response, "X-Frame-Options", "DENY");
    MHD_add_response_header(response, "Referrer-Policy", "no-referrer");
    MHD_add_response_header(response, "Cross-Origin-Resource-Policy", "same-origin");
    MHD_add_response_header(response, "Cross-Origin-Opener-Policy", "same-origin");
}

static struct MHD_Response *plain(const char *text)
{
    struct MHD_Response *response =
        MHD_create_response_from_buffer(strlen(text), (void *)text, MHD_RESPMEM_PERSISTENT);
    if (response)
        MHD_add_response_header(response, "Content-Type", "text/plain; charset=utf-8");
    return response;
}

static struct MHD_Response *page(const preview_server *server)
{
    struct MHD_Response *response =
        MHD_create_response_from_buffer(server->page_size, server->page, MHD_RESPMEM_PERSISTENT);
    if (response)
        MHD_add_response_header(response, "Content-Type", "text/html; charset=utf-8");
    return response;
}

/* Asks for the end of a render that has none yet. */
static void ask_to_stop(const preview_server *server)
{
    board *b = server->board;
    pthread_mutex_lock(&b->lock);
    const int is_over = board_is_over(b);
    pthread_mutex_unlock(&b->lock);
    if (!is_over)
        server->stop();
}

/* A viewer has the last picture, and the answer to its word of that. */
static void note_seen(void *user)
{
    board *b = user;
    pthread_mutex_lock(&b->lock);
    b->satisfied++;
    pthread_cond_broadcast(&b->changed);
    pthread_mutex_unlock(&b->lock);
}

static ssize_t read_thanks(void *user, uint64_t position, char *out, size_t room)
{
    static const char thanks[] = "thanks\n";
    const size_t left = sizeof thanks - 1 - (size_t)position, count = left < room ? left : room;
    (void)user;
    memcpy(out, thanks + position, count);
    return (ssize_t)count;
}

/* Counts once it has been sent: the end of rtc may wait for nothing else. */
static struct MHD_Response *seen(preview_server *server)
{
    enum { BLOCK = 64 };
    return MHD_create_response_from_callback(sizeof "thanks\n" - 1, BLOCK, read_thanks,
                                             server->board, note_seen);
}

static struct MHD_Response *answer(preview_server *server, struct MHD_Connection *connection,
                                   request_answer kind, const char *path, unsigned *status)
{
    struct MHD_Response *response = NULL;
    *status = MHD_HTTP_OK;
    switch (kind) {
    case REQUEST_PAGE:
        return page(server);
    case REQUEST_EVENTS:
        return events(server, connection);
    case REQUEST_PICTURE:
        return picture(server, connection, status);
    case REQUEST_STOP:
        ask_to_stop(server);
        return plain("stopping\n");
    case REQUEST_SEEN:
        return seen(server);
    case REQUEST_FORBIDDEN:
        *status = MHD_HTTP_FORBIDDEN;
        return plain("403: the address of this page is the one that rtc printed\n");
    case REQUEST_UNKNOWN:
        *status = MHD_HTTP_NOT_FOUND;
        return plain("404: there is nothing here\n");
    case REQUEST_NOT_SO:
        *status = MHD_HTTP_METHOD_NOT_ALLOWED;
        response = plain("405: not by this method\n");
        if (response)
            MHD_add_response_header(response, "Allow", request_methods(path));
        return response;
    }
    return NULL;
}

static const char *header(struct MHD_Connection *connection, const char *name)
{
    return MHD_lookup_connection_value(connection, MHD_HEADER_KIND, name);
}

/* No request has a body. */
static int has_body(struct MHD_Connection *connection)
{
    const char *length = header(connection, "Content-Length");
    return (length && strcmp(length, "0") != 0) || header(connection, "Transfer-Encoding");
}

static enum MHD_Result on_request(void *user, struct MHD_Connection *connection, const char *path,
                                  const char *method, const char *version, const char *upload,
                                  size_t *upload_size, void **state)
{
    static int is_begun;
    preview_server *server = user;
    const request asked = {method, path, header(connection, "Host"), header(connection, "Origin"),
                           header(connection, "Sec-Fetch-Site")};
    const request_answer kind = request_route(&asked, server->token, server->port);
    const int is_refused = kind == REQUEST_FORBIDDEN || has_body(connection);
    struct MHD_Response *response;
    unsigned status;
    (void)version;
    (void)upload;
    if (*upload_size > 0)
        return MHD_NO;
    /* The head has come; what may go on is answered when all has. */
    if (!*state && !is_refused) {
        *state = &is_begun;
        return MHD_YES;
    }
    if (kind != REQUEST_FORBIDDEN && is_refused) {
        status = MHD_HTTP_CONTENT_TOO_LARGE;
        response = plain("413: requests have no body here\n");
    } else {
        response = answer(server, connection, kind, path, &status);
    }
    if (!response)
        return MHD_NO;
    add_headers(server, response);
    const enum MHD_Result queued = MHD_queue_response(connection, status, response);
    MHD_destroy_response(response);
    return queued;
}

/* ---- Begin and end -------------------------------------------------------------------- */

/* A socket that listens on the loopback device, and its port; -1 with errno. */
static int listen_on_loopback(unsigned *port)
{
    const int fd = socket(AF_INET, SOCK_STREAM, 0), yes = 1;
    struct sockaddr_in at = {.sin_family = AF_INET, .sin_port = htons((uint16_t)*port)};
    socklen_t size = sizeof at;
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (fd < 0)
        return -1;
    if (setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) == 0 &&
        bind(fd, (struct sockaddr *)&at, sizeof at) == 0 && listen(fd, CONNECTIONS) == 0 &&
        getsockname(fd, (struct sockaddr *)&at, &size) == 0) {
        *port = ntohs(at.sin_port);
        return fd;
    }
    const int code = errno;
    close(fd);
    errno = code;
    return -1;
}

/* The page with the nonce in each place of @NONCE@. */
static int make_page(preview_server *server)
{
    static const char mark[] = "@NONCE@";
    const char *at = (const char *)preview_page_source, *end = at + preview_page_source_size;
    char *out = malloc(preview_page_source_size + 8 * TOKEN_LENGTH);
    server->page = out;
    while (out && at < end) {
        const size_t left = (size_t)(end - at);
        if (left >= sizeof mark - 1 && memcmp(at, mark, sizeof mark - 1) == 0) {
            memcpy(out, server->nonce, TOKEN_LENGTH);
            out += TOKEN_LENGTH;
            at += sizeof mark - 1;
        } else {
            *out++ = *at++;
        }
    }
    server->page_size = out ? (size_t)(out - server->page) : 0;
    return server->page != NULL;
}

static void be_silent(void *user, const char *format, va_list arguments)
{
    (void)user;
    (void)format;
    (void)arguments;
}

/* Starts the server's thread on a socket. */
static int start(preview_server *server, int fd)
{
    server->daemon = MHD_start_daemon(
        MHD_USE_AUTO_INTERNAL_THREAD | MHD_ALLOW_SUSPEND_RESUME | MHD_USE_ERROR_LOG, 0, NULL, NULL,
        on_request, server, MHD_OPTION_EXTERNAL_LOGGER, be_silent, NULL, MHD_OPTION_LISTEN_SOCKET,
        fd, MHD_OPTION_CONNECTION_LIMIT, (unsigned)CONNECTIONS, MHD_OPTION_CONNECTION_TIMEOUT,
        (unsigned)SILENT_SECONDS, MHD_OPTION_CONNECTION_MEMORY_LIMIT, (size_t)REQUEST_BYTES,
        MHD_OPTION_STRICT_FOR_CLIENT, 1, MHD_OPTION_END);
    return server->daemon != NULL;
}

const char *server_open(preview_server **out, board *board, unsigned port, void (*stop)(void))
{
    const char *why = NULL;
    preview_server *server = calloc(1, sizeof *server);
    if (!server)
        return "out of memory";
    server->board = board;
    server->stop = stop;
    server->port = port;
    const int fd = listen_on_loopback(&server->port);
    if (fd < 0)
        why = strerror(errno);
    else if (!request_make_token(server->token) || !request_make_token(server->nonce))
        why = "the system has no random numbers";
    else if (!make_page(server))
        why = "out of memory";
    if (why && fd >= 0)
        close(fd);
    /* From here on the daemon has the socket. */
    if (!why && !start(server, fd))
        why = "libmicrohttpd does not start";
    if (why) {
        free(server->page);
        free(server);
        return why;
    }
    snprintf(server->address, sizeof server->address, "http://127.0.0.1:%u/%s/", server->port,
             server->token);
    pthread_mutex_lock(&board->lock);
    board->wake = wake;
    board->wake_user = server;
    pthread_mutex_unlock(&board->lock);
    *out = server;
    return NULL;
}

const char *server_address(const preview_server *server)
{
    return server->address;
}

void server_close(preview_server *server)
{
    if (!server)
        return;
    board *b = server->board;
    MHD_stop_daemon(server->daemon);
    pthread_mutex_lock(&b->lock);
    b->wake = NULL;
    pthread_mutex_unlock(&b->lock);
    free(server->page);
    free(server);
}
