/* wire.c - messages by MPI, waited for in small sleeps: MPI's own waiting takes a whole core. */
#include "wire.h"

#include <mpi.h>
#include <time.h>

enum { PIECE = 1 << 28 }; /* bytes, of a long message */

void wire_rest(void)
{
    const struct timespec time = {0, 500000};
    nanosleep(&time, NULL);
}

void wire_send(int to, int tag, const message *message)
{
    MPI_Send(message, (int)sizeof *message, MPI_BYTE, to, tag, MPI_COMM_WORLD);
}

int wire_is_there(int from, int tag, int *sender)
{
    MPI_Status status;
    int is_there = 0;
    MPI_Iprobe(from == WIRE_ANY ? MPI_ANY_SOURCE : from, tag, MPI_COMM_WORLD, &is_there, &status);
    if (is_there && sender)
        *sender = status.MPI_SOURCE;
    return is_there;
}

message wire_receive(int from, int tag)
{
    message message;
    while (!wire_is_there(from, tag, NULL))
        wire_rest();
    MPI_Recv(&message, (int)sizeof message, MPI_BYTE, from, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return message;
}

void wire_send_bytes(int to, int tag, const void *data, size_t size)
{
    const char *at = data;
    for (size_t now; size > 0; at += now, size -= now) {
        now = size < PIECE ? size : PIECE;
        MPI_Send(at, (int)now, MPI_BYTE, to, tag, MPI_COMM_WORLD);
    }
}

void wire_receive_bytes(int from, int tag, void *data, size_t size)
{
    char *at = data;
    for (size_t now; size > 0; at += now, size -= now) {
        now = size < PIECE ? size : PIECE;
        MPI_Recv(at, (int)now, MPI_BYTE, from, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    }
}

int wire_parent(int rank)
{
    return rank & (rank - 1);
}

void wire_pass_on(int rank, int ranks, const void *data, size_t size)
{
    const message head = {.kind = MESSAGE_MAP, .count = size};
    /* The children of a rank are it plus each power of two below its lowest bit. */
    int bit = 1;
    while (bit < ranks && !(rank & bit))
        bit <<= 1;
    for (bit >>= 1; bit > 0; bit >>= 1)
        if (rank + bit < ranks) {
            wire_send(rank + bit, TAG_MAP, &head);
            wire_send_bytes(rank + bit, TAG_MAP, data, size);
        }
}

void wire_abort(int status)
{
    MPI_Abort(MPI_COMM_WORLD, status);
}
