#pragma once
#include <string>

namespace tessera::viewer {

/// The viewer's events, one line each on stdout, for programs that drive it; off by default.
class EventLog {
public:
    explicit EventLog(bool on) : on_(on) {}
    /// Joins the lines of a text, such as a shader compiler's log, into one line.
    void line(const std::string& text) const;

private:
    bool on_;
};

} // namespace tessera::viewer
