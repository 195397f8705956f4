#include <algorithm>
#include <array>
#include <regex>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "renderer/shader/Preprocess.h"
#include "renderer/shader/ShaderPath.h"

namespace tessera::shader {
namespace {

/// A compiler's format of source positions.
struct Dialect {
    std::regex pattern;
    std::size_t file, line; ///< groups of the source string number and of the line
    std::size_t severity;   ///< group of a severity before the position; 0: it follows the position
};

const std::array<Dialect, 3>& dialects() {
    static const std::array<Dialect, 3> list{
        Dialect{std::regex(R"(^(\d+):(\d+)\(\d+\): )"), 1, 2, 0},           // Mesa "0:12(5): error: "
        Dialect{std::regex(R"(^(\d+)\((\d+)\) : )"), 1, 2, 0},              // NVIDIA "0(12) : error C1008: "
        Dialect{std::regex(R"(^(ERROR|WARNING): (\d+):(\d+): )"), 2, 3, 1}, // glslang, AMD, Intel "ERROR: 0:12: "
    };
    return list;
}

std::string mapLine(const std::string& line, std::span<const std::string> files) {
    for (const Dialect& dialect : dialects()) {
        std::smatch match;
        if (!std::regex_search(line, match, dialect.pattern)) continue;
        // Numbers with more digits than file or line numbers have are not positions.
        if (match.length(dialect.file) > 6 || match.length(dialect.line) > 10) return line;
        const std::size_t number = std::stoull(match.str(dialect.line));
        const std::size_t file = number < kLinesAFile ? std::stoul(match.str(dialect.file)) : number / kLinesAFile;
        if (file >= files.size()) return line;
        std::string severity;
        if (dialect.severity != 0) severity = match.str(dialect.severity) == "ERROR" ? "error: " : "warning: ";
        if (number % kLinesAFile == 0) return severity + match.suffix().str(); // lines count from 1: not a position
        return fmt::format("{}:{}: {}{}", displayPath(files[file]), number % kLinesAFile, severity,
                           match.suffix().str());
    }
    return line;
}

} // namespace

std::string mapLog(std::string_view log, std::span<const std::string> files) {
    std::string mapped;
    while (!log.empty()) {
        const std::size_t end = log.find('\n');
        mapped += mapLine(std::string(log.substr(0, end)), files);
        if (end == std::string_view::npos) break;
        mapped += '\n';
        log.remove_prefix(end + 1);
    }
    return mapped;
}

std::string errorsFirst(std::string_view mappedLog) {
    std::vector<std::string_view> lines;
    while (!mappedLog.empty()) {
        const std::size_t end = std::min(mappedLog.find('\n'), mappedLog.size());
        lines.push_back(mappedLog.substr(0, end));
        mappedLog.remove_prefix(std::min(end + 1, mappedLog.size()));
    }
    // NVIDIA adds a number: "warning C7050: x".
    std::stable_partition(lines.begin(), lines.end(), [](std::string_view line) {
        return line.find(": warning") == std::string_view::npos || line.find(": error") != std::string_view::npos;
    });
    return fmt::format("{}", fmt::join(lines, "\n"));
}

} // namespace tessera::shader
