#include "apps/Interrupt.h"

#include <csignal>

#include "base/AtomicFile.h"
#include "base/EndRequest.h"

namespace tessera::app {

namespace {

/// Makes only async-signal-safe calls. SA_RESETHAND has restored the default action; the raised signal is delivered
/// after the return and ends the program.
void cleanUpAndEnd(int signal) {
    if (noteEnd(signal)) return; // the holder ends the program soon; a second signal ends it at once
    removeTemporaries();
    std::raise(signal);
}

} // namespace

void cleanUpWhenInterrupted() {
    // Exceeding the file size limit then fails the write, like a full disk, instead of ending the program.
    std::signal(SIGXFSZ, SIG_IGN);
    // A closed stderr must not lose the image. endAsByClosedPipe() handles a closed stdout.
    std::signal(SIGPIPE, SIG_IGN);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
        struct sigaction old {};
        // A signal that the parent had ignored, as nohup does, stays ignored.
        if (sigaction(signal, nullptr, &old) != 0 || old.sa_handler == SIG_IGN) continue;
        struct sigaction action {};
        action.sa_handler = cleanUpAndEnd;
        action.sa_flags = int(SA_RESETHAND);
        sigfillset(&action.sa_mask);
        sigaction(signal, &action, nullptr);
    }
}

void endAsByClosedPipe() {
    removeTemporaries();
    std::signal(SIGPIPE, SIG_DFL);
    std::raise(SIGPIPE);
}

} // namespace tessera::app
