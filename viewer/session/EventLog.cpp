#include "viewer/session/EventLog.h"

#include <cstdio>

#include <fmt/format.h>

#include "base/OneLine.h"

namespace tessera::viewer {
void EventLog::line(const std::string& text) const {
    if (!on_) return;
    fmt::print("{}\n", oneLine(text, text.max_size())); // untruncated: it may be a command to be run
    std::fflush(stdout);                                // programs that drive the viewer act on each line
}

} // namespace tessera::viewer
