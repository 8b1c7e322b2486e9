/*
 * target_request.c - what another program of the machine may send to the page of a preview, a part
 * of the request a line; the value of --preview; and the state that the page is told, with any text
 * in its title and messages.
 */
#include <stdlib.h>
#include <string.h>

#include "fuzz/json.h"
#include "fuzz/targets.h"
#include "tools/preview/board.h"
#include "tools/preview/request.h"
#include "tools/preview/target.h"

static const char token[] = "0123456789abcdef0123456789abcdef";
enum { PORT = 8080, PARTS = 7 };

static int is_one_of(const char *text, const char *a, const char *b)
{
    return text && (strcmp(text, a) == 0 || strcmp(text, b) == 0);
}

/* What has the token and comes from here alone is let in. */
static int check_route(const request *r)
{
    const request_answer answer = request_route(r, token, PORT);
    FUZZ_EXPECT(answer <= REQUEST_NOT_SO);
    FUZZ_EXPECT(r->path == NULL || strlen(request_methods(r->path)) > 0);
    if (answer == REQUEST_FORBIDDEN)
        return 0;
    FUZZ_EXPECT(strncmp(r->path + 1, token, TOKEN_LENGTH) == 0);
    FUZZ_EXPECT(is_one_of(r->host, "127.0.0.1:8080", "localhost:8080"));
    FUZZ_EXPECT(!r->origin ||
                is_one_of(r->origin, "http://127.0.0.1:8080", "http://localhost:8080"));
    FUZZ_EXPECT(answer != REQUEST_STOP || strcmp(r->method, "POST") == 0);
    return 1;
}

static int check_target(const char *text)
{
    preview_target target;
    if (!preview_target_read(&target, text))
        return 0;
    FUZZ_EXPECT(target.port < 65536 && memchr(target.host, '\0', sizeof target.host));
    FUZZ_EXPECT(target.is_tev ? target.port > 0 && target.host[0] : !target.host[0]);
    FUZZ_EXPECT(!target.is_tev || !target.opens);
    return 1;
}

static void check_state(const char *text)
{
    uint64_t version = 0;
    board b;
    board_begin(&b, text);
    for (int i = 0; i < BOARD_MESSAGES + 2; i++)
        board_say(&b, "error", text + (size_t)i % (strlen(text) + 1));
    char *json = board_json(&b, &version);
    rt_bytes line = {0};
    FUZZ_EXPECT(json && !strchr(json, '\n') && version == b.message_version);
    fuzz_put_text(&line, json);
    fuzz_put(&line, "\n", 2);
    FUZZ_EXPECT(fuzz_is_json_lines((const char *)line.data));
    rt_bytes_free(&line);
    free(json);
    board_free(&b);
}

static int run(const uint8_t *data, size_t size)
{
    const char *parts[PARTS] = {NULL};
    char *text = malloc(size + 1);
    FUZZ_EXPECT(text != NULL);
    memcpy(text, data, size);
    text[size] = '\0';
    char *at = text;
    for (int i = 0; i < PARTS && at; i++) {
        char *end = strchr(at, '\n');
        /* A line with a dash is a header that is not there. */
        parts[i] = at;
        if (end)
            *end = '\0';
        if (strcmp(at, "-") == 0)
            parts[i] = NULL;
        at = end ? end + 1 : NULL;
    }
    const request r = {parts[0] ? parts[0] : "GET", parts[1], parts[2], parts[3], parts[4]};
    int is_good = check_route(&r);
    is_good |= check_target(parts[5] ? parts[5] : "");
    check_state(parts[6] ? parts[6] : "");
    free(text);
    return is_good;
}

static void seed(fuzz_inputs *seeds)
{
    static const char *const lines[] = {
        "GET\n/0123456789abcdef0123456789abcdef/\n127.0.0.1:8080\n-\nnone\npage:8080\na.rts",
        ("POST\n/0123456789abcdef0123456789abcdef/stop\nlocalhost:8080\nhttp://127.0.0.1:8080\n"
         "same-origin\ntev:[::1]:9000\na.rts:1:1: error: '\303\244'\t\\ \"x\""),
        "HEAD\n/0123456789abcdef0123456789abcdef/picture\n127.0.0.1:8080\n-\n-\ntev:desk\n\377\001",
        "GET\n/0123456789abcdef0123456789abcdef/events\n127.0.0.1:8080\n-\n-\ntev\n\360\237",
        "POST\n/0123456789abcdef0123456789abcdef/seen\n127.0.0.1:8080\n-\ncross-site\nopen\n-",
        "GET\n/\nevil.example\nhttp://evil.example\ncross-site\ntev:\n",
    };
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++)
        fuzz_add_text(seeds, lines[i]);
}

const fuzz_target fuzz_target_request = {
    .name = "request",
    .sources = "tools/preview/board* tools/preview/request.c tools/preview/target.c",
    .run = run,
    .seed = seed,
    .size_max = 1024,
    .tries = 20000,
};
