/* interrupt.c - what Ctrl-C and SIGTERM do. */
#include "interrupt.h"

#include <errno.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>

#include "status.h"

static volatile sig_atomic_t deferred, pending;
static int as_json, is_quiet;

/* Only write() may be called in a handler. */
static void say(const char *plain, const char *json)
{
    const char *text = as_json ? json : plain;
    if (is_quiet)
        return;
    if (write(STDERR_FILENO, text, strlen(text)) < 0) {
        /* There is nobody to tell. */
    }
}

static void handle(int signal_number)
{
    int saved = errno;
    if (!deferred) {
        say("\nrtc: interrupted; nothing was written\n",
            "{\"severity\":\"note\",\"message\":\"interrupted; nothing was written\"}\n");
        _exit(STATUS_INTERRUPTED);
    }
    if (pending) {
        /* The second one: end as the signal does, once it is no longer blocked. */
        signal(signal_number, SIG_DFL);
        raise(signal_number);
        return;
    }
    pending = 1;
    say("\nrtc: stopping; interrupt again to stop at once\n",
        "{\"severity\":\"note\",\"message\":\"stopping; interrupt again to stop at once\"}\n");
    errno = saved;
}

static void catch_one(int signal_number)
{
    struct sigaction old, action = {0};
    if (sigaction(signal_number, NULL, &old) != 0 || old.sa_handler == SIG_IGN)
        return;
    action.sa_handler = handle;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaddset(&action.sa_mask, SIGINT);
    sigaddset(&action.sa_mask, SIGTERM);
    sigaction(signal_number, &action, NULL);
}

void interrupt_catch(int in_json, int quiet)
{
    as_json = in_json;
    is_quiet = quiet;
    catch_one(SIGINT);
    catch_one(SIGTERM);
}

void interrupt_defer(void)
{
    deferred = 1;
}

int interrupt_pending(void)
{
    return pending;
}
