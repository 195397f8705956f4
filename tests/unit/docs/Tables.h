#pragma once
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace tessera::test {

inline const std::filesystem::path kRepository = TESSERA_SOURCE_DIR;

inline std::string textOf(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

/// The README and the documents of docs/.
inline std::vector<std::filesystem::path> documents() {
    std::vector<std::filesystem::path> found{kRepository / "README.md"};
    for (const auto& entry : std::filesystem::directory_iterator(kRepository / "docs"))
        if (entry.path().extension() == ".md") found.push_back(entry.path());
    return found;
}

/// Rows of a Markdown table.
using Rows = std::vector<std::vector<std::string>>;
inline std::string markdownTable(const std::vector<std::string>& head, const Rows& rows) {
    const auto line = [](const std::vector<std::string>& cells) {
        std::string text = "|";
        for (const std::string& cell : cells) text += (cell.empty() ? "" : " " + cell) + " |";
        return text + "\n";
    };
    std::string text = line(head) + "|";
    for (std::size_t i = 0; i < head.size(); ++i) text += "---|";
    text += "\n";
    for (const std::vector<std::string>& row : rows) text += line(row);
    return text;
}

/// Returns whether the document contains exactly this table: these lines, and no further row.
inline bool holdsTable(const std::string& document, const std::string& table) {
    const std::size_t at = document.find(table);
    if (at == std::string::npos) return false;
    const std::size_t end = at + table.size();
    return end >= document.size() || document[end] != '|';
}

} // namespace tessera::test
