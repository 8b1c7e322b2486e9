/* request.c - decides what a request to the page of a preview has. */
#include "request.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/random.h>

/* What lies behind the token. */
typedef struct place {
    const char *name;
    request_answer answer;
    int is_post; /* by POST alone; else by GET, and HEAD where its size is known */
    int has_head;
} place;

static const place places[] = {
    {"", REQUEST_PAGE, 0, 1},           {"events", REQUEST_EVENTS, 0, 0},
    {"picture", REQUEST_PICTURE, 0, 1}, {"stop", REQUEST_STOP, 1, 0},
    {"seen", REQUEST_SEEN, 1, 0},
};

static const place *find_place(const char *name)
{
    for (size_t i = 0; i < sizeof places / sizeof *places; i++)
        if (strcmp(places[i].name, name) == 0)
            return places + i;
    return NULL;
}

/* Whether a header is `before`, a name of this machine, a colon and the port. */
static int names_us(const char *header, const char *before, unsigned port)
{
    static const char *const names[] = {"127.0.0.1", "localhost"};
    char expected[64];
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        snprintf(expected, sizeof expected, "%s%s:%u", before, names[i], port);
        if (strcmp(header, expected) == 0)
            return 1;
    }
    return 0;
}

/* Behind "/", the token and "/"; NULL where it is another. In the same time for every guess. */
static const char *behind_token(const char *path, const char *token)
{
    unsigned differs = 0;
    if (path[0] != '/' || strnlen(path, TOKEN_LENGTH + 2) < TOKEN_LENGTH + 2)
        return NULL;
    for (size_t i = 0; i < TOKEN_LENGTH; i++)
        differs |= (unsigned char)path[i + 1] ^ (unsigned char)token[i];
    return differs == 0 && path[TOKEN_LENGTH + 1] == '/' ? path + TOKEN_LENGTH + 2 : NULL;
}

/* Whether a request comes from a page elsewhere; there may be a link to the page itself. */
static int is_foreign(const request *r, const place *place, unsigned port)
{
    if (r->origin && !names_us(r->origin, "http://", port))
        return 1;
    const int may_be_linked = place && place->answer == REQUEST_PAGE;
    return !may_be_linked && r->fetch_site && strcmp(r->fetch_site, "same-origin") != 0 &&
           strcmp(r->fetch_site, "none") != 0;
}

request_answer request_route(const request *r, const char *token, unsigned port)
{
    const char *name = r->path ? behind_token(r->path, token) : NULL;
    const place *place = name ? find_place(name) : NULL;
    if (!name || !r->host || !names_us(r->host, "", port) || is_foreign(r, place, port))
        return REQUEST_FORBIDDEN;
    if (!place)
        return REQUEST_UNKNOWN;
    const int is_get = strcmp(r->method, "GET") == 0, is_head = strcmp(r->method, "HEAD") == 0;
    const int is_post = strcmp(r->method, "POST") == 0;
    const int fits = place->is_post ? is_post : is_get || (is_head && place->has_head);
    return fits ? place->answer : REQUEST_NOT_SO;
}

const char *request_methods(const char *path)
{
    const char *slash = strrchr(path, '/');
    const place *place = find_place(slash ? slash + 1 : path);
    return place && place->is_post ? "POST" : place && place->has_head ? "GET, HEAD" : "GET";
}

int request_make_token(char token[TOKEN_LENGTH + 1])
{
    unsigned char bytes[TOKEN_LENGTH / 2];
    for (size_t got = 0; got < sizeof bytes;) {
        const ssize_t more = getrandom(bytes + got, sizeof bytes - got, 0);
        if (more < 0 && errno != EINTR)
            return 0;
        got += more > 0 ? (size_t)more : 0;
    }
    for (size_t i = 0; i < sizeof bytes; i++)
        snprintf(token + 2 * i, 3, "%02x", bytes[i]);
    return 1;
}
