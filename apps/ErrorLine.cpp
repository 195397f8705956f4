#include "apps/ErrorLine.h"

#include <cstdio>

#include <fmt/format.h>

#include "scenes/Utf8.h"

namespace tessera::app {

std::string oneLine(std::string_view text) {
    std::string line;
    bool isNew = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto c = static_cast<unsigned char>(text[i]);
        if (c == '\n' || c == '\r') {
            isNew = !line.empty();
            continue;
        }
        if (isNew) line += "; ";
        isNew = false;
        const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0;
        if (c < 0x20 || c == 0x7f) {
            line += fmt::format("\\x{:02x}", c);
        } else if (c == 0xc2 && next >= 0x80 && next < 0xa0) { // U+0080 to U+009F in UTF-8
            line += fmt::format("\\x{:02x}", next);
            ++i;
        } else {
            line += text[i];
        }
    }
    constexpr std::size_t kMostBytes = 2000; // of what files say: one word of theirs may have megabytes
    if (line.size() > kMostBytes) line = std::string(beginningOf(line, kMostBytes)) + "...";
    return line;
}

void printProblem(std::string_view text) {
    const std::string line = "tessera: " + oneLine(text) + "\n";
    std::fwrite(line.data(), 1, line.size(), stderr);
}

} // namespace tessera::app
