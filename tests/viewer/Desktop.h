#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include <glm/vec2.hpp>

#include "tests/support/Process.h"
#include "tests/support/TempFolder.h"

namespace tessera::test {

/// A screen of its own that no monitor shows (Xvfb), with a window manager (Openbox) that binds no key but Alt+F4,
/// no button, and draws no frames: the one window is at the upper left.
class Desktop {
public:
    explicit Desktop(glm::ivec2 sizePixels);

    const std::string& display() const { return display_; } ///< as in DISPLAY
    glm::ivec2 sizePixels() const { return sizePixels_; }

    /// Runs xdotool, whose events come from the X server as a user's do, and returns what it printed. Throws
    /// std::runtime_error when it fails.
    std::string xdotool(const std::vector<std::string>& words) const;
    /// All that the screen shows, as a PNG file.
    void capture(const std::filesystem::path& file) const;

private:
    glm::ivec2 sizePixels_;
    TempFolder folder_;
    std::unique_ptr<Process> server_;
    std::string display_;
    std::unique_ptr<Process> manager_;
};

} // namespace tessera::test
