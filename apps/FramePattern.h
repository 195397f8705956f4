#pragma once
#include <filesystem>
#include <string>

namespace tessera::app {

/// A file name with one place for a frame number: %d, or %04d for at least four digits.
class FramePattern {
public:
    /// Throws InputError when the pattern has no such place, or more than one.
    explicit FramePattern(const std::string& pattern);
    /// Whether the name of a file has a part that can hardly be anything else.
    static bool hasPlace(const std::filesystem::path& file);
    std::string path(int frame) const;

private:
    std::string before_, after_;
    std::size_t digits_ = 1;
};

} // namespace tessera::app
