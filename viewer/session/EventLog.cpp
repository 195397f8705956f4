#include "viewer/session/EventLog.h"

#include <cstdio>

#include <fmt/format.h>

namespace tessera::viewer {

void EventLog::line(const std::string& text) const {
    if (!on_) return;
    std::string oneLine = text;
    for (char& c : oneLine)
        if (c == '\n') c = ';';
    fmt::print("{}\n", oneLine);
    std::fflush(stdout); // whoever reads acts on it now
}

} // namespace tessera::viewer
