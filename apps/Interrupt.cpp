#include "apps/Interrupt.h"

#include <csignal>

#include "validation/AtomicFile.h"

namespace tessera::app {

namespace {

/// Only async-signal-safe calls. SA_RESETHAND has put the signal's own action back, and it is held until the return.
void cleanUpAndEnd(int signal) {
    validation::removeTemporaries();
    std::raise(signal);
}

} // namespace

void cleanUpWhenInterrupted() {
    // A file that grows beyond what is allowed is then an error of the write, as a full disk is.
    std::signal(SIGXFSZ, SIG_IGN);
    // A reader of messages who left must not cost the picture; endAsByClosedPipe() is for the output's.
    std::signal(SIGPIPE, SIG_IGN);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
        struct sigaction old {};
        // Who is told to ignore a signal, as by nohup, goes on.
        if (sigaction(signal, nullptr, &old) != 0 || old.sa_handler == SIG_IGN) continue;
        struct sigaction action {};
        action.sa_handler = cleanUpAndEnd;
        action.sa_flags = int(SA_RESETHAND);
        sigfillset(&action.sa_mask);
        sigaction(signal, &action, nullptr);
    }
}

void endAsByClosedPipe() {
    validation::removeTemporaries();
    std::signal(SIGPIPE, SIG_DFL);
    std::raise(SIGPIPE);
}

} // namespace tessera::app
