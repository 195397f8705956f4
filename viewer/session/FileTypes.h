#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace tessera::viewer {

/// File types that the viewer opens and saves, by extension: the one table for the dialog, drops and messages.
struct FileType {
    enum class Opens : std::uint8_t { Nothing, Scene, Environment };
    enum class Saves : std::uint8_t { Nothing, Scene, Display, Radiance };
    std::string_view extension; ///< ".png"
    Opens opens = Opens::Nothing;
    Saves saves = Saves::Nothing;
    std::string_view meaning; ///< of the saved content, else of the opened content
};
std::span<const FileType> fileTypes();

/// The type of a file name; null if the viewer neither opens nor saves it.
const FileType* fileTypeOf(const std::filesystem::path& file);

/// Files that were dropped together.
struct Dropped {
    std::string taken; ///< to be opened
    std::string left;  ///< message about the others, one line; empty: none
};
/// Takes the first file that opens as a scene or an environment, else the first file, whose load then fails with the
/// reason. Requires at least one file.
Dropped takeDropped(std::span<const std::string> files);

} // namespace tessera::viewer
