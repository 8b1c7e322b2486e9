/* tev.h - sends pictures to the viewer tev, by its protocol over TCP. */
#ifndef RTC_PREVIEW_TEV_H
#define RTC_PREVIEW_TEV_H

#include "board.h"

typedef struct tev tev;

/*
 * Connects to a tev that listens, and sends from now on what the board shows: its picture whenever
 * that is new, and at the end all layers. Returns NULL, or why it cannot be. The caller owns *out.
 */
const char *tev_open(tev **out, board *board, const char *host, unsigned port);

/* Ends, when board_close has been called. Takes NULL. Returns whether all could be sent. */
int tev_close(tev *tev);

#endif
