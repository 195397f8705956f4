#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace tessera::app {

/// A path with one frame-number placeholder in its file name: %d, or %04d for at least four digits. Folder names are
/// taken literally.
class FramePattern {
public:
    /// Throws InputError if the file name has no placeholder, more than one, or another %.
    explicit FramePattern(const std::string& pattern);
    /// Whether a file name contains what is almost certainly a placeholder.
    static bool hasPlace(const std::filesystem::path& file);
    /// `frame` is 0 or more.
    std::string path(int frame) const;
    /// The path with a word in place of the number, for files that belong to all frames.
    std::string pathWith(std::string_view word) const { return before_ + std::string(word) + after_; }

private:
    std::string before_, after_;
    std::size_t digits_ = 1;
};

} // namespace tessera::app
