#include "validation/report/Html.h"

#include <algorithm>

#include "base/Utf8.h"

namespace tessera::validation {

std::string escapedHtml(std::string_view text) {
    constexpr std::string_view kReplacement = "\xef\xbf\xbd"; // U+FFFD
    std::string html;
    html.reserve(text.size());
    while (!text.empty()) {
        const std::size_t length = letterBytes(text);
        const char first = text.front();
        const bool isControl = (first >= 0 && first < 0x20 && first != '\n' && first != '\t') || first == 0x7f;
        if (length == 0 || isControl)
            html += kReplacement;
        else if (first == '&')
            html += "&amp;";
        else if (first == '<')
            html += "&lt;";
        else if (first == '>')
            html += "&gt;";
        else if (first == '"')
            html += "&quot;";
        else if (first == '\'')
            html += "&#39;";
        else
            html += text.substr(0, length);
        text.remove_prefix(length == 0 ? 1 : length);
    }
    return html;
}

std::string escapedWhole(std::string_view text) {
    constexpr std::size_t kMostBytes = 24; // longer words do not fit a narrow window
    constexpr std::string_view kGaps = " \n\t";
    std::string html;
    while (!text.empty()) {
        const std::size_t gap = std::min(text.find_first_not_of(kGaps), text.size());
        html += text.substr(0, gap);
        text.remove_prefix(gap);
        const std::string_view word = text.substr(0, text.find_first_of(kGaps));
        const bool isWhole = word.find('-') != std::string_view::npos && word.size() <= kMostBytes;
        html += isWhole ? "<span class=\"whole\">" + escapedHtml(word) + "</span>" : escapedHtml(word);
        text.remove_prefix(word.size());
    }
    return html;
}

std::string pngDataUri(std::span<const std::uint8_t> bytes) {
    return "data:image/png;base64," + base64(bytes);
}

std::string base64(std::span<const std::uint8_t> bytes) {
    constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = bytes.size() - i < 3 ? bytes.size() - i : 3;
        std::uint32_t group = 0; // up to three bytes, the first in the highest bits
        for (std::size_t j = 0; j < count; ++j) group |= std::uint32_t(bytes[i + j]) << (16 - 8 * j);
        for (std::size_t j = 0; j < 4; ++j) text += j <= count ? kDigits[group >> (18 - 6 * j) & 63] : '=';
    }
    return text;
}

} // namespace tessera::validation
