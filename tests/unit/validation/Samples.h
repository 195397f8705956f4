#pragma once
#include <atomic>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "base/Picture.h"

namespace tessera::validation {

struct Rgb {
    float r, g, b;
};

/// An image of these colours, row by row from the top; every pixel is covered.
inline Picture pictureOf(int width, int height, const std::vector<Rgb>& colours) {
    Picture picture{width, height, {}, std::vector<std::uint8_t>(colours.size(), 1)};
    for (const Rgb& c : colours) picture.rgba.insert(picture.rgba.end(), {c.r, c.g, c.b, 1.f});
    return picture;
}

inline Picture greyPicture(int width, int height, float value) {
    return pictureOf(width, height, std::vector<Rgb>(std::size_t(width * height), Rgb{value, value, value}));
}

inline void setPixel(Picture& picture, std::size_t index, Rgb c) {
    picture.rgba[4 * index] = c.r;
    picture.rgba[4 * index + 1] = c.g;
    picture.rgba[4 * index + 2] = c.b;
}

/// A new empty folder that is deleted after the test.
class TemporaryFolder {
public:
    TemporaryFolder() {
        static std::atomic<int> number = 0;
        path_ = std::filesystem::temp_directory_path() / fmt::format("tessera-test-{}-{}", ::getpid(), number++);
        std::filesystem::create_directory(path_);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    std::string file(const std::string& name) const { return (path_ / name).string(); }
    std::string path() const { return path_.string(); }
    std::size_t entries() const {
        return std::size_t(
            std::distance(std::filesystem::directory_iterator(path_), std::filesystem::directory_iterator()));
    }

private:
    std::filesystem::path path_;
};

inline std::string readText(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline void writeText(const std::string& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

} // namespace tessera::validation
