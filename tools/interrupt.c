#include "interrupt.h"

#include <errno.h>
#include <signal.h>
#include <unistd.h>

#include "rtc.h"

static volatile sig_atomic_t deferred, pending;

static void say(const char *text, size_t length)
{
    if (write(STDERR_FILENO, text, length) < 0) {
        /* There is nobody to tell. */
    }
}

static void handle(int signal_number)
{
    static const char stopped[] = "\nrtc: interrupted; nothing was written\n";
    static const char stopping[] = "\nrtc: stopping; interrupt again to stop at once\n";
    int saved = errno;
    if (!deferred) {
        say(stopped, sizeof stopped - 1);
        _exit(STATUS_INTERRUPTED);
    }
    if (pending) {
        /* The second one: end as the signal does, once it is no longer blocked. */
        signal(signal_number, SIG_DFL);
        raise(signal_number);
        return;
    }
    pending = 1;
    say(stopping, sizeof stopping - 1);
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

void interrupt_catch(void)
{
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
