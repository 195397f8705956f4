#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

namespace tessera::test {

/// Drops files onto a window at a place of the screen in pixels, as a file manager does, and waits until the window has
/// taken them. `window` is X11's number of it. Paths are absolute, of letters that URIs take as they are. Throws
/// std::runtime_error where the window does not take them within 30 s. Source: freedesktop.org, "Drag-and-Drop Protocol
/// for the X Window System", version 5.
void dropFiles(const std::string& display, const std::string& window, glm::ivec2 pixel,
               const std::vector<std::filesystem::path>& files);

} // namespace tessera::test
