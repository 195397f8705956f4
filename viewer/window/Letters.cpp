#include "viewer/window/Letters.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "base/Utf8.h"

namespace tessera::viewer {
namespace {

using Range = std::pair<std::uint16_t, std::uint16_t>;

/// Basic Latin and Latin-1; dashes, quotation marks and the ellipsis.
constexpr std::array kFirstLetters{Range{0x20, 0xff}, Range{0x2010, 0x2026}};
/// Radicals to Yi, Hangul, compatibility ideographs, and forms of full width. Source: The Unicode Standard, blocks.
constexpr std::array kEastAsian{Range{0x2e80, 0xa4cf}, Range{0xac00, 0xd7ff}, Range{0xf900, 0xfaff},
                                Range{0xfe30, 0xfe4f}, Range{0xff00, 0xffef}};

bool isIn(std::span<const Range> ranges, std::uint32_t letter) {
    return std::ranges::any_of(
        ranges, [letter](const Range& range) { return letter >= range.first && letter <= range.second; });
}

/// Decodes the first letter of a text, of so many bytes.
std::uint32_t letterOf(std::string_view text, std::size_t bytes) {
    const auto byte = [text](std::size_t i) { return std::uint32_t(static_cast<unsigned char>(text[i])); };
    if (bytes == 1) return byte(0);
    std::uint32_t letter = byte(0) & (0xffu >> (bytes + 1));
    for (std::size_t i = 1; i < bytes; ++i) letter = letter << 6 | (byte(i) & 0x3fu);
    return letter;
}

} // namespace

void Letters::note(std::string_view text) {
    while (true) {
        // Skips ASCII: names of a hundred thousand files are noted in every frame, most of which have nothing else.
        const auto beyond =
            std::ranges::find_if(text, [](char byte) { return (static_cast<unsigned char>(byte) & 0x80u) != 0; });
        text.remove_prefix(std::size_t(beyond - text.begin()));
        if (text.empty()) return;
        const std::size_t bytes = letterBytes(text);
        if (bytes > 1) {
            const std::uint32_t letter = letterOf(text, bytes);
            if (letter <= 0xffff && !isIn(kFirstLetters, letter) && more_.insert(std::uint16_t(letter)).second)
                isNew_ = true;
        }
        text.remove_prefix(std::max<std::size_t>(bytes, 1));
    }
}

bool Letters::takeNew() {
    return std::exchange(isNew_, false);
}

bool Letters::hasEastAsian() const {
    return std::ranges::any_of(more_, [](std::uint16_t letter) { return isIn(kEastAsian, letter); });
}

std::vector<std::uint16_t> Letters::ranges() const {
    std::vector<Range> rows(kFirstLetters.begin(), kFirstLetters.end());
    for (const std::uint16_t letter : more_) rows.emplace_back(letter, letter);
    std::ranges::sort(rows);
    std::vector<std::uint16_t> ranges;
    for (const auto& [first, last] : rows) {
        if (!ranges.empty() && ranges.back() + 1 == first) {
            ranges.back() = last;
        } else {
            ranges.push_back(first);
            ranges.push_back(last);
        }
    }
    ranges.push_back(0);
    return ranges;
}

} // namespace tessera::viewer
