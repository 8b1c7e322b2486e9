/*
 * wire.h - what the processes of a render say to each other. Rank 0 leads, all others work. All
 * machines have the same byte order.
 */
#ifndef RTC_MPI_WIRE_H
#define RTC_MPI_WIRE_H

#include <stddef.h>
#include <stdint.h>

/* The channels. */
enum {
    TAG_UP = 1, /* messages of workers */
    TAG_DOWN,   /* answers */
    TAG_DATA,   /* bytes behind a message, either way */
    TAG_STOP,   /* a worker is to hand over what it has, and to end */
    TAG_FILM,   /* a film, from worker to worker */
    TAG_MAP     /* the photon map, from process to process */
};

typedef enum message_kind {
    /* of workers */
    MESSAGE_HELLO,     /* what is the note of the film to be resumed? */
    MESSAGE_BEGIN,     /* from how many samples is a finished film raised? */
    MESSAGE_ASK,       /* first, count and seconds of what was rendered; what comes next? */
    MESSAGE_FILM,      /* count bytes follow; none: there is no film */
    MESSAGE_COLLECTED, /* count films of rank `first` are added to this one's */
    MESSAGE_MAP,       /* count bytes follow: the part of the photon map */
    MESSAGE_BYE,       /* ended with the exit status `first`; count bytes say why */
    /* of rank 0 */
    MESSAGE_NOTE,      /* count bytes follow */
    MESSAGE_RAISED,    /* from `first` samples, or none */
    MESSAGE_RENDER,    /* units first .. first + count - 1 */
    MESSAGE_HAND_OVER, /* the film to rank `first`, then ask again */
    MESSAGE_COLLECT,   /* the film that rank `first` hands over, then ask again */
    MESSAGE_END
} message_kind;

typedef struct message {
    uint64_t kind, first, count;
    double seconds;
} message;

/* Ends all processes at once. */
void wire_abort(int status);

/* Waits for a little while. */
void wire_rest(void);

void wire_send(int to, int tag, const message *message);

enum { WIRE_ANY = -1 }; /* whatever rank */

/* Whether a message is there from this rank or WIRE_ANY; *from receives its sender. */
int wire_is_there(int from, int tag, int *sender);

/* Receives a message, for which it waits without using the processor. */
message wire_receive(int from, int tag);

/* Bytes of any number, in pieces that MPI can count. */
void wire_send_bytes(int to, int tag, const void *data, size_t size);
void wire_receive_bytes(int from, int tag, void *data, size_t size);

/* Passes bytes that came from rank 0 on to others, so that all get them in log2(ranks) steps. */
void wire_pass_on(int rank, int ranks, const void *data, size_t size);

/* The rank from which this one gets such bytes. */
int wire_parent(int rank);

#endif
