#include "base/EndRequest.h"

#include <atomic>
#include <csignal>

#include "base/AtomicFile.h"

namespace tessera {
namespace {

std::atomic<bool> endIsHeld{false};
std::atomic<int> endNoted{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "handlers of signals use them");

} // namespace

void holdEnd(bool isHeld) noexcept {
    endIsHeld = isHeld;
}

bool noteEnd(int signal) noexcept {
    if (!endIsHeld) return false;
    endNoted = signal;
    return true;
}

int notedEnd() noexcept {
    return endNoted;
}

void endAsNoted() {
    removeTemporaries();
    std::raise(endNoted);
}

} // namespace tessera
