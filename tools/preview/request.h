/* request.h - what a request to the page of a preview may have. */
#ifndef RTC_PREVIEW_REQUEST_H
#define RTC_PREVIEW_REQUEST_H

/* The secret in the page's address: 128 random bits in hexadecimal. */
enum { TOKEN_LENGTH = 32 };

typedef enum request_answer {
    REQUEST_PAGE,
    REQUEST_EVENTS,
    REQUEST_PICTURE,
    REQUEST_STOP,
    REQUEST_SEEN,
    REQUEST_FORBIDDEN, /* 403: without the token, or from another page */
    REQUEST_UNKNOWN,   /* 404 */
    REQUEST_NOT_SO     /* 405: not by this method */
} request_answer;

/* The parts of a request that decide; a header that it lacks is NULL. */
typedef struct request {
    const char *method, *path, *host, *origin;
    const char *fetch_site; /* Sec-Fetch-Site */
} request;

/*
 * What a request has. It must name this machine, 127.0.0.1 or localhost, and the port in Host, so
 * that no name of a stranger's stands for it, carry the token in its path, and come from no page
 * but its own.
 */
request_answer request_route(const request *request, const char *token, unsigned port);

/* The methods that a path takes, for the header Allow. */
const char *request_methods(const char *path);

/* Makes a token. Returns 0 where the system has no random numbers. */
int request_make_token(char token[TOKEN_LENGTH + 1]);

#endif
