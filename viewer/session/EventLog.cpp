#include "viewer/session/EventLog.h"

#include <cstdio>

#include <fmt/format.h>

namespace tessera::viewer {
namespace {

std::string oneLine(std::string text) {
    for (char& c : text)
        if (c == '\n') c = ';';
    return text;
}

} // namespace

void EventLog::line(const std::string& text) const {
    if (!on_) return;
    fmt::print("{}\n", oneLine(text));
    std::fflush(stdout); // whoever reads acts on it now
}

} // namespace tessera::viewer
