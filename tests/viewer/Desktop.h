#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include <glm/vec2.hpp>

#include "tests/support/Process.h"
#include "tests/support/TempFolder.h"

namespace tessera::test {

/// A virtual screen (Xvfb) with a window manager (Openbox) that binds no key but Alt+F4 and no button, and draws no
/// frames: the only window is at the upper left.
class Desktop {
public:
    explicit Desktop(glm::ivec2 sizePixels);

    const std::string& display() const { return display_; } ///< as in DISPLAY
    glm::ivec2 sizePixels() const { return sizePixels_; }

    /// Runs xdotool, whose events come from the X server like a user's, and returns its output. Throws
    /// std::runtime_error if it fails.
    std::string xdotool(const std::vector<std::string>& words) const;
    /// Saves the screen's contents as a PNG file.
    void capture(const std::filesystem::path& file) const;

private:
    glm::ivec2 sizePixels_;
    TempFolder folder_;
    std::unique_ptr<Process> server_;
    std::string display_;
    std::unique_ptr<Process> manager_;
};

} // namespace tessera::test
