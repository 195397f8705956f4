#pragma once
#include <algorithm>
#include <string>
#include <string_view>

/// Case-insensitive ASCII text. Other bytes are unchanged, whatever the locale.
namespace tessera {

constexpr char inLowercase(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

inline std::string inLowercase(std::string text) {
    for (char& c : text) c = inLowercase(c);
    return text;
}

constexpr bool isSameWord(std::string_view a, std::string_view b) {
    return std::ranges::equal(a, b, [](char x, char y) { return inLowercase(x) == inLowercase(y); });
}

constexpr bool startsWithWord(std::string_view text, std::string_view beginning) {
    return text.size() >= beginning.size() && isSameWord(text.substr(0, beginning.size()), beginning);
}

} // namespace tessera
