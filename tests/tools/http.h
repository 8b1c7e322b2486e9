/* http.h - requests as a browser, or a stranger, would send them. */
#ifndef RT_TESTS_TOOLS_HTTP_H
#define RT_TESTS_TOOLS_HTTP_H

#include <stddef.h>

/* What came back. */
typedef struct http_answer {
    int status; /* 0: nothing, or no HTTP */
    char *text; /* head and body, with a zero byte behind; to be freed */
    size_t size;
    const char *body; /* in text */
    size_t body_size;
} http_answer;

/* A connection to 127.0.0.1, or -1. Reading and writing take some seconds at most. */
int http_connect(unsigned port);

/* Sends the text, and reads what comes until the other side closes. */
http_answer http_send(unsigned port, const char *text);

/* The same for METHOD PATH with a right Host, and further lines of the head. */
http_answer http_ask(unsigned port, const char *method, const char *path, const char *lines);
void http_free(http_answer *answer);

/* Reads from a connection until text shows; returns whether it did. */
int http_wait_for(int fd, const char *text);

#endif
