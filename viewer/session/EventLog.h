#pragma once
#include <string>

namespace tessera::viewer {

/// What the viewer does, a line an event on stdout, for programs that drive it; silent unless asked for.
class EventLog {
public:
    explicit EventLog(bool on) : on_(on) {}
    /// A text of several lines, such as a shader compiler's log, becomes one line.
    void line(const std::string& text) const;

private:
    bool on_;
};

} // namespace tessera::viewer
