/*
 * delay_bridge.c - a network with a delay, for kernels without netem: passes Ethernet frames on
 * among TAP devices, each a fixed time after it came.
 *
 *     delay_bridge MILLISECONDS TAP...    makes the devices, prints "ready", and runs until killed
 *     delay_bridge --round-trip ADDRESS   milliseconds until a connection there is refused
 *
 * A device may be moved to a network namespace afterwards: it stays this program's.
 */
#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <linux/if.h>
#include <linux/if_tun.h>
#include <poll.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

/* Frames on their way at a time; more are lost, as in any network. */
enum { MOST_PORTS = 16, MOST_FRAMES = 1 << 14, FRAME_BYTES = 2048, ADDRESS_BYTES = 6 };

typedef struct frame {
    double due;
    size_t size;
    int from;
    uint8_t bytes[FRAME_BYTES];
} frame;

typedef struct bridge {
    int count;
    struct pollfd ports[MOST_PORTS];
    uint8_t addresses[MOST_PORTS][ADDRESS_BYTES]; /* of who spoke last at a port */
    frame *frames[MOST_FRAMES];                   /* a ring, in the order in which they are due */
    size_t first, waiting;
} bridge;

static void need(int is_done, const char *what)
{
    if (is_done)
        return;
    fprintf(stderr, "delay_bridge: %s: %s\n", what, strerror(errno));
    exit(1);
}

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* A TAP device, made anew. */
static int open_tap(const char *name)
{
    struct ifreq request = {.ifr_flags = IFF_TAP | IFF_NO_PI};
    const int fd = open("/dev/net/tun", O_RDWR | O_NONBLOCK);
    need(fd >= 0, "/dev/net/tun");
    snprintf(request.ifr_name, sizeof request.ifr_name, "%s", name);
    need(ioctl(fd, TUNSETIFF, &request) == 0, name);
    return fd;
}

/* Takes what came to a port. */
static void take(bridge *b, int port, double delay)
{
    while (b->waiting < MOST_FRAMES) {
        frame *f = malloc(sizeof *f);
        need(f != NULL, "memory");
        const ssize_t size = read(b->ports[port].fd, f->bytes, sizeof f->bytes);
        if (size < 2 * ADDRESS_BYTES) {
            free(f);
            return;
        }
        f->size = (size_t)size;
        f->from = port;
        f->due = now() + delay;
        memcpy(b->addresses[port], f->bytes + ADDRESS_BYTES, ADDRESS_BYTES);
        b->frames[(b->first + b->waiting++) % MOST_FRAMES] = f;
    }
}

/* Gives a frame to the port where its address is, or to all others. */
static void give(const bridge *b, const frame *f)
{
    int to = -1;
    for (int i = 0; i < b->count; i++)
        if (i != f->from && memcmp(b->addresses[i], f->bytes, ADDRESS_BYTES) == 0)
            to = i;
    for (int i = 0; i < b->count; i++)
        if (i != f->from && (to < 0 || to == i) && write(b->ports[i].fd, f->bytes, f->size) < 0)
            continue; /* a port that is down or full loses it */
}

static void run(bridge *b, double delay)
{
    for (;;) {
        double wait = 1;
        while (b->waiting > 0) {
            frame *f = b->frames[b->first];
            wait = f->due - now();
            if (wait > 0)
                break;
            give(b, f);
            free(f);
            b->first = (b->first + 1) % MOST_FRAMES;
            b->waiting--;
            wait = 1;
        }
        poll(b->ports, (nfds_t)b->count, (int)(1e3 * wait) + 1);
        for (int i = 0; i < b->count; i++)
            take(b, i, delay);
    }
}

/* Nobody listens at the port of `discard`: the answer to the second attempt takes one way and back,
 * as addresses are known then. */
static int round_trip(const char *address)
{
    struct sockaddr_in to = {.sin_family = AF_INET, .sin_port = htons(9)};
    double began = 0;
    need(inet_pton(AF_INET, address, &to.sin_addr) == 1, address);
    for (int i = 0; i < 2; i++) {
        const int fd = socket(AF_INET, SOCK_STREAM, 0);
        need(fd >= 0, "socket");
        began = now();
        need(connect(fd, (const struct sockaddr *)&to, sizeof to) != 0 && errno == ECONNREFUSED,
             address);
        close(fd);
    }
    printf("%.1f\n", 1e3 * (now() - began));
    return 0;
}

int main(int argc, char **argv)
{
    static bridge b;
    if (argc == 3 && strcmp(argv[1], "--round-trip") == 0)
        return round_trip(argv[2]);
    b.count = argc - 2;
    if (b.count < 1 || b.count > MOST_PORTS) {
        fprintf(stderr, "delay_bridge: MILLISECONDS TAP..., 1 to %d of these\n", MOST_PORTS);
        return 2;
    }
    for (int i = 0; i < b.count; i++)
        b.ports[i] = (struct pollfd){open_tap(argv[i + 2]), POLLIN, 0};
    puts("ready");
    fflush(stdout);
    run(&b, 1e-3 * atof(argv[1]));
    return 0;
}
