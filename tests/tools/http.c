/* http.c - a client of HTTP that does as it is told. */
#define _GNU_SOURCE 1 /* memmem */

#include "http.h"

#include <arpa/inet.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

int http_connect(unsigned port)
{
    const struct timeval patience = {.tv_sec = 100};
    struct sockaddr_in at = {.sin_family = AF_INET, .sin_port = htons((unsigned short)port)};
    const int fd = socket(AF_INET, SOCK_STREAM, 0);
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    setsockopt(fd, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
    if (fd >= 0 && connect(fd, (struct sockaddr *)&at, sizeof at) == 0)
        return fd;
    close(fd);
    return -1;
}

/* Reads to the end. */
static void read_all(http_answer *a, int fd)
{
    enum { STEP = 1 << 16 };
    ssize_t got = 1;
    while (got > 0) {
        char *more = realloc(a->text, a->size + STEP + 1);
        if (!more)
            break;
        a->text = more;
        got = recv(fd, a->text + a->size, STEP, 0);
        a->size += got > 0 ? (size_t)got : 0;
        a->text[a->size] = '\0';
    }
}

http_answer http_send(unsigned port, const char *text)
{
    http_answer a = {0};
    const int fd = http_connect(port);
    size_t left = strlen(text);
    for (ssize_t sent = 1; fd >= 0 && left > 0 && sent > 0;) {
        sent = send(fd, text, left, MSG_NOSIGNAL);
        text += sent > 0 ? sent : 0;
        left -= sent > 0 ? (size_t)sent : 0;
    }
    if (fd >= 0)
        read_all(&a, fd);
    close(fd);
    const char *end = a.text ? memmem(a.text, a.size, "\r\n\r\n", 4) : NULL;
    if (!a.text || sscanf(a.text, "HTTP/1.%*d %d", &a.status) != 1)
        a.status = 0;
    a.body = end ? end + 4 : NULL;
    a.body_size = end ? a.size - (size_t)(a.body - a.text) : 0;
    return a;
}

http_answer http_ask(unsigned port, const char *method, const char *path, const char *lines)
{
    char text[2048];
    snprintf(text, sizeof text,
             "%s %s HTTP/1.1\r\nHost: 127.0.0.1:%u\r\nConnection: close\r\n%s\r\n", method, path,
             port, lines ? lines : "");
    return http_send(port, text);
}

void http_free(http_answer *answer)
{
    free(answer->text);
    *answer = (http_answer){0};
}

int http_wait_for(int fd, const char *text)
{
    char kept[1 << 16];
    size_t size = 0;
    for (;;) {
        if (size + 1 >= sizeof kept) { /* keep the end, where the text may have begun */
            memmove(kept, kept + size / 2, size - size / 2);
            size -= size / 2;
        }
        const ssize_t got = recv(fd, kept + size, sizeof kept - 1 - size, 0);
        if (got <= 0)
            return 0;
        size += (size_t)got;
        if (memmem(kept, size, text, strlen(text)))
            return 1;
    }
}
