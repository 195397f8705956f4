#pragma once
#include <string>

namespace tessera::viewer {

/// The viewer's events, a line each on stdout, for programs that drive it; silent by default.
class EventLog {
public:
    explicit EventLog(bool on) : on_(on) {}
    /// A text of several lines, such as a shader compiler's log, becomes one line.
    void line(const std::string& text) const;

private:
    bool on_;
};

} // namespace tessera::viewer
