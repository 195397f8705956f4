#include "viewer/session/FieldLetters.h"

#include <algorithm>
#include <cstddef>
#include <optional>

#include "base/Utf8.h"

namespace tessera::viewer {
namespace {

// The private use area. Source: The Unicode Standard, section 23.5.
constexpr std::size_t kFirstPrivate = 0xe000, kPrivateLetters = 6400;

/// In UTF-8, three bytes each.
std::string privateLetter(std::size_t number) {
    const std::size_t letter = kFirstPrivate + number;
    return {char(0xe0 | (letter >> 12)), char(0x80 | ((letter >> 6) & 0x3f)), char(0x80 | (letter & 0x3f))};
}

std::optional<std::size_t> privateNumber(std::string_view letter) {
    if (letter.size() != 3) return std::nullopt;
    const auto bits = [&](std::size_t byte, unsigned mask) {
        return std::size_t(static_cast<unsigned char>(letter[byte]) & mask);
    };
    const std::size_t value = bits(0, 0x0fu) << 12 | bits(1, 0x3fu) << 6 | bits(2, 0x3fu);
    if (value < kFirstPrivate || value >= kFirstPrivate + kPrivateLetters) return std::nullopt;
    return value - kFirstPrivate;
}

/// The first character of a text; its first byte if it is invalid UTF-8.
std::string_view firstLetter(std::string_view text) {
    return text.substr(0, std::max<std::size_t>(letterBytes(text), 1));
}

bool isHeld(std::string_view letter) {
    const auto first = static_cast<unsigned char>(letter.front());
    if (letter.size() == 1) return first >= 0x20 && first < 0x7f;
    return letter.size() < 4 && !privateNumber(letter);
}

} // namespace

std::string FieldLetters::inField(std::string_view text) {
    std::string held;
    while (!text.empty()) {
        const std::string_view letter = firstLetter(text);
        text.remove_prefix(letter.size());
        if (isHeld(letter)) {
            held += letter;
            continue;
        }
        const auto known = std::ranges::find(letters_, letter);
        const auto number = std::size_t(known - letters_.begin());
        if (known == letters_.end() && letters_.size() < kPrivateLetters) letters_.emplace_back(letter);
        held += number < kPrivateLetters ? privateLetter(number) : std::string(letter);
    }
    return held;
}

std::string FieldLetters::fromField(std::string_view held) const {
    std::string text;
    while (!held.empty()) {
        const std::string_view letter = firstLetter(held);
        held.remove_prefix(letter.size());
        const std::optional<std::size_t> number = privateNumber(letter);
        text += number && *number < letters_.size() ? std::string_view(letters_[*number]) : letter;
    }
    return text;
}

} // namespace tessera::viewer
