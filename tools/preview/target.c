/* target.c - reads the value of --preview. */
#include "target.h"

#include <string.h>

/* Where tev listens, and which of the machine's names that is. */
enum { TEV_PORT = 14158 };
static const char tev_host[] = "127.0.0.1";

/* A port, 1 to 65535, in decimal. */
static int read_port(unsigned *out, const char *text)
{
    unsigned port = 0;
    size_t digits = strspn(text, "0123456789");
    if (digits == 0 || digits > 5 || text[digits])
        return 0;
    for (const char *c = text; *c; c++)
        port = 10 * port + (unsigned)(*c - '0');
    if (port == 0 || port > 65535)
        return 0;
    *out = port;
    return 1;
}

/* A host of `length` characters. */
static int read_host(preview_target *out, const char *text, size_t length)
{
    if (length == 0 || length >= sizeof out->host)
        return 0;
    memcpy(out->host, text, length);
    out->host[length] = '\0';
    return 1;
}

/* HOST, PORT or HOST:PORT, where a host with colons stands in brackets. */
static int read_place(preview_target *out, const char *text)
{
    const char *bracket = text[0] == '[' ? strchr(text, ']') : NULL;
    if (text[0] == '[' && !bracket)
        return 0;
    if (text[strspn(text, "0123456789")] == '\0')
        return read_port(&out->port, text);
    const char *host = bracket ? text + 1 : text, *end = bracket ? bracket : strchr(text, ':');
    const size_t length = end ? (size_t)(end - host) : strlen(host);
    const char *rest = bracket ? bracket + 1 : end ? end : "";
    if (!read_host(out, host, length))
        return 0;
    return !rest[0] || (rest[0] == ':' && read_port(&out->port, rest + 1));
}

int preview_target_read(preview_target *out, const char *text)
{
    const size_t length = strcspn(text, ":");
    const char *rest = text[length] ? text + length + 1 : NULL;
    *out = (preview_target){0};
    out->is_tev = length == 3 && memcmp(text, "tev", 3) == 0;
    out->opens = length == 4 && memcmp(text, "open", 4) == 0;
    if (!out->is_tev && !out->opens && !(length == 4 && memcmp(text, "page", 4) == 0))
        return 0;
    if (!out->is_tev)
        return !rest || read_port(&out->port, rest);
    memcpy(out->host, tev_host, sizeof tev_host);
    out->port = TEV_PORT;
    return !rest || read_place(out, rest);
}
