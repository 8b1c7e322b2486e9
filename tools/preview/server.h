/*
 * server.h - the page of a preview: HTTP by libmicrohttpd on the loopback device alone, behind a
 * random token. No file of the machine is served.
 */
#ifndef RTC_PREVIEW_SERVER_H
#define RTC_PREVIEW_SERVER_H

#include "board.h"
#include "request.h"

typedef struct preview_server preview_server;

enum { SERVER_ADDRESS = 80 };

/*
 * Begins to serve what the board shows. port 0: any that is free. stop is called, from another
 * thread, where a viewer asks for the end of the render. Returns NULL, or why it cannot be. The
 * caller owns *out.
 */
const char *server_open(preview_server **out, board *board, unsigned port, void (*stop)(void));

/* "http://127.0.0.1:PORT/TOKEN/" */
const char *server_address(const preview_server *server);

/* Ends, when board_close has been called. Takes NULL. */
void server_close(preview_server *server);

#endif
