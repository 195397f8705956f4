#include "viewer/session/EventLog.h"

#include <cstdio>

#include <fmt/format.h>

#include "base/OneLine.h"

namespace tessera::viewer {
void EventLog::line(const std::string& text) const {
    if (!on_) return;
    fmt::print("{}\n", oneLine(text, text.max_size())); // whole: it holds commands to be run
    std::fflush(stdout);                                // a program that drives the viewer acts on each line
}

} // namespace tessera::viewer
