#pragma once
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "tests/support/Process.h"
#include "tests/viewer/Desktop.h"

namespace tessera::test {

/// A screen image: 8 bits per channel, rows from the top.
struct Shot {
    glm::ivec2 sizePixels{0};
    std::vector<std::uint8_t> rgb;

    glm::ivec3 at(glm::ivec2 pixel) const;
    /// A rectangle of the image.
    Shot part(glm::ivec2 corner, glm::ivec2 size) const;
    bool operator==(const Shot&) const = default;
};
/// Reads an 8-bit image file.
Shot readShot(const std::filesystem::path& file);
/// Fraction of the pixels that differ in any channel by more than `steps`; 1 for images of different sizes.
double differingShare(const Shot& a, const Shot& b, int steps = 0);

/// `tessera view --log` on a desktop, operated like a person would: by keys, mouse and window manager.
class DrivenViewer {
public:
    /// Waits until the window exists. Files are saved in `folder`, settings in its subfolder "config". If there are no
    /// settings, edges are not smoothed.
    DrivenViewer(const Desktop& desktop, const std::filesystem::path& folder, const std::vector<std::string>& arguments,
                 const std::map<std::string, std::string>& environment = {});

    // ---- Event log ----
    std::vector<std::string> lines() const;
    std::size_t mark() const { return lines().size(); } ///< the current end of the log
    /// The first line after a mark that begins with `begin`; throws std::runtime_error after `seconds`.
    std::string waitFor(const std::string& begin, std::size_t from, double seconds = 60.0) const;
    /// Waits for a whole image drawn after a mark, and until nothing more is drawn; returns its size in pixels.
    glm::ivec2 waitForWhole(std::size_t from) const;

    // ---- User input ----
    void key(const std::string& chord) const; ///< xdotool's names: "F12", "ctrl+s"
    void type(const std::string& text) const; ///< letter by letter
    void hold(const std::string& key, double seconds) const;
    void moveTo(glm::ivec2 pixel) const;
    void click(glm::ivec2 pixel, const std::string& held = "") const;
    void doubleClick(glm::ivec2 pixel) const;
    /// Drags via ten points, with keys held. X11's button 1 is the left one, 3 the right one.
    void drag(glm::ivec2 from, glm::ivec2 to, const std::string& held = "", int button = 1) const;
    void wheel(int clicks, const std::string& held = "") const; ///< positive: away from the user
    /// See dropFiles().
    void drop(glm::ivec2 pixel, const std::vector<std::filesystem::path>& files) const;
    void resize(glm::ivec2 sizePixels) const;
    void minimise() const;
    void pause(double seconds) const;
    void restore() const;

    Shot capture() const;
    /// Waits for the end; returns the exit code, or none if a signal ended it.
    std::optional<int> wait();
    void send(int signal) const;
    /// Closes the window through the window manager.
    void close() const;
    const std::string& errors() const { return errors_; } ///< stderr, after wait()

private:
    const Desktop& desktop_;
    std::filesystem::path folder_;
    std::string window_;
    std::unique_ptr<Process> process_;
    std::string errors_;
};

} // namespace tessera::test
