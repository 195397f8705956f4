#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera::test {

/// Drops files onto a window at a screen position in pixels, like a file manager, and waits until the window has
/// accepted them. `window` is its X11 number. Paths are absolute, of characters that URIs need not escape. Throws
/// std::runtime_error if the window does not accept them within 30 s. Source: freedesktop.org, "Drag-and-Drop Protocol
/// for the X Window System", version 5.
void dropFiles(const std::string& display, const std::string& window, glm::ivec2 pixel,
               const std::vector<std::filesystem::path>& files);

} // namespace tessera::test
