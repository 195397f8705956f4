#include "renderer/shader/LineScanner.h"

#include <algorithm>
#include <cctype>

namespace tessera::shader {
namespace {

bool isSpace(char c) {
    return std::isspace(static_cast<unsigned char>(c)) != 0;
}
bool isWord(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && isSpace(text.front())) text.remove_prefix(1);
    while (!text.empty() && isSpace(text.back())) text.remove_suffix(1);
    return text;
}

} // namespace

Directive LineScanner::next(std::string_view line) {
    const bool startsInside = isOpen();
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    const bool continues = !line.empty() && line.back() == '\\';
    if (continues) line.remove_suffix(1);
    code_ = withoutComments(line);
    inContinuation_ = continues;
    if (!continues) inLineComment_ = false;

    std::string_view rest = trimmed(code_);
    if (startsInside || rest.empty() || rest.front() != '#') return {};
    rest = trimmed(rest.substr(1));
    const auto end = std::find_if_not(rest.begin(), rest.end(), isWord);
    const auto length = std::size_t(end - rest.begin());
    return {std::string(rest.substr(0, length)), std::string(trimmed(rest.substr(length)))};
}

std::string LineScanner::withoutComments(std::string_view line) {
    std::string code;
    bool inQuotes = false; // GLSL has no strings, but the path of an #include may hold //
    for (std::size_t i = 0; i < line.size(); ++i) {
        const std::string_view two = line.substr(i, 2);
        if (inLineComment_) break;
        if (inBlockComment_) {
            if (two == "*/") {
                inBlockComment_ = false;
                code += ' ';
                ++i;
            }
        } else if (two == "//" && !inQuotes) {
            inLineComment_ = true;
        } else if (two == "/*" && !inQuotes) {
            inBlockComment_ = true;
            ++i;
        } else {
            if (line[i] == '"') inQuotes = !inQuotes;
            code += line[i];
        }
    }
    return code;
}

} // namespace tessera::shader
