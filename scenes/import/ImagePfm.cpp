#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

#include <glm/glm.hpp>

#include "scenes/import/PictureCodecs.h"

namespace tessera::scenes {
namespace {

constexpr bool isSpace(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// The words of a PFM's header, and where its texels begin.
class Header {
public:
    explicit Header(std::string_view text) : text_(text) {}

    /// Empty where the text ends, or goes on for longer than a number does. The one space after it is taken too.
    std::string_view word() {
        constexpr std::size_t kMostCharacters = 64;
        while (at_ < text_.size() && isSpace(text_[at_])) ++at_;
        const std::size_t first = at_;
        while (at_ < text_.size() && at_ - first < kMostCharacters && !isSpace(text_[at_])) ++at_;
        if (at_ == text_.size() || !isSpace(text_[at_])) return {};
        return text_.substr(first, at_++ - first);
    }

    std::size_t end() const { return at_; }

private:
    std::string_view text_;
    std::size_t at_ = 0;
};

template <typename Number>
bool readNumber(std::string_view word, Number& number) {
    const auto [rest, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    return error == std::errc() && rest == word.data() + word.size();
}

} // namespace

/// Source: Debevec, "Portable FloatMap Image Format": PF or Pf (grey), width, height and scale; rows from the bottom.
/// Texels are multiplied by the scale, whose sign tells the order of their bytes: below 0 is little-endian.
DecodedPicture decodePfm(const PictureSource& source) {
    Header header({reinterpret_cast<const char*>(source.bytes.data()), source.bytes.size()});
    const std::size_t channels = header.word() == "PF" ? 3 : 1;
    std::int32_t width = 0, height = 0;
    float scale = 0.0f;
    source.require(readNumber(header.word(), width) && readNumber(header.word(), height) && width > 0 && height > 0,
                   "it has no size");
    source.require(readNumber(header.word(), scale) && std::isfinite(scale) && scale != 0.0f, "it has no scale");
    const std::size_t columns = std::size_t(width), rows = std::size_t(height);
    const std::span<const std::byte> stored = source.bytes.subspan(header.end());
    source.require(stored.size() / (channels * sizeof(float)) / columns >= rows, "it ends early");
    DecodedPicture decoded = source.blank(width, height, TexelFormat::Rgba32Float, sizeof(glm::vec4));
    decoded.tags.isLinear = true;
    const bool isSwapped = (scale < 0.0f) != (std::endian::native == std::endian::little);
    const auto valueAt = [&](std::size_t index) {
        std::array<std::byte, sizeof(float)> value;
        std::memcpy(value.data(), stored.data() + index * sizeof(float), sizeof(float));
        if (isSwapped) std::ranges::reverse(value);
        return std::bit_cast<float>(value) * std::abs(scale);
    };
    const std::span<glm::vec4> texels = texelsOf<glm::vec4>(decoded.image);
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < columns; ++column) {
            const std::size_t first = ((rows - 1 - row) * columns + column) * channels;
            texels[row * columns + column] = {valueAt(first), valueAt(first + channels / 2),
                                              valueAt(first + channels - 1), 1.0f};
        }
    return decoded;
}

} // namespace tessera::scenes
