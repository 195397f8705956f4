#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace tessera::app {

/// A path whose file name has one place for a frame number: %d, or %04d for at least four digits. Names of folders are
/// taken as they are.
class FramePattern {
public:
    /// Throws InputError when the file name has no such place, more than one, or another %.
    explicit FramePattern(const std::string& pattern);
    /// Whether the name of a file has a part that can hardly be anything else.
    static bool hasPlace(const std::filesystem::path& file);
    /// `frame` is 0 or more.
    std::string path(int frame) const;
    /// With a word in the number's place: the name of what belongs to all frames.
    std::string pathWith(std::string_view word) const { return before_ + std::string(word) + after_; }

private:
    std::string before_, after_;
    std::size_t digits_ = 1;
};

} // namespace tessera::app
