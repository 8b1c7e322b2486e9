/* target.h - what --preview asks for: a page of its own, or the viewer tev. */
#ifndef RTC_PREVIEW_TARGET_H
#define RTC_PREVIEW_TARGET_H

enum { TARGET_HOST = 254 };

typedef struct preview_target {
    int is_tev;
    int opens;              /* the page is opened in a browser */
    unsigned port;          /* 0: any that is free */
    char host[TARGET_HOST]; /* of tev: a name or an address, without brackets */
} preview_target;

/*
 * Reads page, open, page:PORT, open:PORT, tev, tev:PORT, tev:HOST or tev:HOST:PORT; an IPv6 address
 * stands in brackets. Returns whether it is one of them.
 */
int preview_target_read(preview_target *out, const char *text);

#endif
