#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace tessera::viewer {

/// What the viewer opens and saves, by the ends of names: the one list that dialog, drops and messages follow.
struct FileType {
    enum class Opens : std::uint8_t { Nothing, Scene, Environment };
    enum class Saves : std::uint8_t { Nothing, Scene, Display, Radiance };
    std::string_view extension; ///< ".png"
    Opens opens = Opens::Nothing;
    Saves saves = Saves::Nothing;
    std::string_view meaning; ///< of what is saved, else of what is opened
};
std::span<const FileType> fileTypes();

/// That of a name; null where the viewer neither opens nor saves any such file.
const FileType* fileTypeOf(const std::filesystem::path& file);

/// Files that were dropped at once.
struct Dropped {
    std::string taken; ///< opens
    std::string left;  ///< what the user is told of the others, a line; empty: there are none
};
/// Takes the first that opens as a scene or an environment; where none does the first, of which loading tells why. At
/// least one file.
Dropped takeDropped(std::span<const std::string> files);

} // namespace tessera::viewer
