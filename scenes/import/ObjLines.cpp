#include "scenes/import/ObjLines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/Error.h"
#include "scenes/import/FileBytes.h"

namespace tessera::scenes::obj {
namespace {

constexpr std::string_view kBlank = " \t\r\v\f";

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(kBlank);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

/// Takes the line at `at` from `text`; ends are LF, CR LF or CR.
std::string_view takeLine(std::string_view text, std::size_t& at) {
    const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
    const std::string_view line = text.substr(at, end - at);
    at = end;
    if (at < text.size()) at += text.substr(at, 2) == "\r\n" ? 2 : 1;
    return line;
}

std::string_view withoutPlus(std::string_view word) {
    if (word.size() > 1 && word.front() == '+' && word[1] != '-') word.remove_prefix(1);
    return word;
}

template <typename Value>
std::optional<Value> parseWhole(std::string_view word) {
    word = withoutPlus(word);
    Value value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error == std::errc::result_out_of_range && end == word.data() + word.size()) {
        if constexpr (std::numeric_limits<Value>::has_infinity) {
            // Too small for a double is 0; too large has a positive exponent.
            const std::size_t exponent = word.find_first_of("eE");
            const bool tiny = exponent != std::string_view::npos && word.substr(exponent + 1, 1) == "-";
            return tiny ? Value{} : std::numeric_limits<Value>::infinity();
        }
    }
    if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    return value;
}

} // namespace

void forEachLine(std::string_view text, const std::function<void(const Line&)>& visit) {
    Line line;
    std::string joined;
    int number = 0;
    for (std::size_t at = 0; at < text.size();) {
        std::string_view content = trimmed(takeLine(text, at));
        line.number = ++number;
        if (content.empty() || content.front() == '#') continue;
        if (content.back() == '\\' && at < text.size()) {
            joined.clear();
            while (!content.empty() && content.back() == '\\') {
                joined.append(content.substr(0, content.size() - 1)).append(" ");
                if (at >= text.size()) {
                    content = {};
                    break;
                }
                content = trimmed(takeLine(text, at));
                ++number;
            }
            joined.append(content);
            content = trimmed(joined);
            if (content.empty()) continue;
        }
        const std::size_t keywordEnd = std::min(content.find_first_of(kBlank), content.size());
        line.keyword = content.substr(0, keywordEnd);
        line.rest = trimmed(content.substr(keywordEnd));
        line.words.clear();
        for (std::size_t i = line.rest.find_first_not_of(kBlank); i < line.rest.size();) {
            const std::size_t end = std::min(line.rest.find_first_of(kBlank, i), line.rest.size());
            line.words.push_back(line.rest.substr(i, end - i));
            i = line.rest.find_first_not_of(kBlank, end);
        }
        visit(line);
    }
}

std::optional<double> parseNumber(std::string_view word) {
    return parseWhole<double>(word);
}

std::optional<long long> parseInteger(std::string_view word) {
    return parseWhole<long long>(word);
}

float finiteNumber(const std::filesystem::path& file, const Line& line, std::string_view word) {
    const std::optional<double> number = parseNumber(word);
    if (!number) failAt(file, line.number, fmt::format("'{}' needs a number, not '{}'", line.keyword, word));
    if (!std::isfinite(*number) || std::abs(*number) > std::numeric_limits<float>::max())
        failAt(file, line.number,
               fmt::format("'{}' is given {}, which is not a finite number in single precision", line.keyword, word));
    return static_cast<float>(*number);
}

void failAt(const std::filesystem::path& file, int line, const std::string& what) {
    throw InputError(fmt::format("{}:{}: {}", file.string(), line, what));
}

std::string readText(const std::filesystem::path& file, LoadLedger& ledger) {
    const std::vector<std::byte> bytes = readFileBytes(file, ledger);
    ledger.charge(bytes.size(), [&] { return file.string(); }); // once more as text
    std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
    if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
        throw InputError(file.string() + ": the text is UTF-16; save it as UTF-8");
    if (text.empty()) throw InputError(file.string() + ": the file is empty; export the model again");
    return text;
}

} // namespace tessera::scenes::obj
