#include "renderer/graph/Table.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace tessera::graph {
namespace {

constexpr std::size_t kIndent = 2;
constexpr std::size_t kGap = 2;
constexpr std::size_t kNarrowest = 4; ///< least width of a column, characters

bool startsCharacter(char byte) {
    return (static_cast<unsigned char>(byte) & 0xC0u) != 0x80u;
}

std::size_t length(const std::string& text) {
    return std::size_t(std::count_if(text.begin(), text.end(), startsCharacter));
}

/// Cuts the first `count` characters off `text` and returns them.
std::string takeFront(std::string& text, std::size_t count) {
    std::size_t end = 0;
    for (std::size_t characters = 0; end < text.size(); ++end)
        if (startsCharacter(text[end]) && characters++ == count) break;
    std::string front = text.substr(0, end);
    text.erase(0, end);
    return front;
}

} // namespace

std::vector<std::string> wrapText(const std::string& text, std::size_t width) {
    assert(width > 0);
    std::vector<std::string> lines;
    std::string line;
    std::size_t at = 0;
    while (at < text.size()) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        std::string word = text.substr(at, end - at);
        at = end + 1;
        if (!line.empty() && length(line) + 1 + length(word) <= width) {
            line += ' ' + word;
            continue;
        }
        if (!line.empty()) lines.push_back(std::move(line));
        for (std::size_t left = length(word); left > width; left -= width) lines.push_back(takeFront(word, width));
        line = std::move(word);
    }
    if (!line.empty() || lines.empty()) lines.push_back(std::move(line));
    return lines;
}

void Table::addColumn(std::string title, Align align, Cells cells) {
    columns_.push_back({std::move(title), align, cells});
}

void Table::addRow(std::vector<std::string> cells) {
    assert(cells.size() == columns_.size());
    rows_.push_back(std::move(cells));
}

std::vector<std::size_t> Table::columnWidths() const {
    std::vector<std::size_t> widths;
    for (const Column& column : columns_) widths.push_back(length(column.title));
    for (const std::vector<std::string>& row : rows_)
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], length(row[i]));
    const std::size_t around = kIndent + kGap * (columns_.size() - 1);
    while (std::accumulate(widths.begin(), widths.end(), around) > width_) {
        std::size_t* widest = nullptr;
        for (std::size_t i = 0; i < widths.size(); ++i)
            if (columns_[i].cells == Cells::Break && widths[i] > kNarrowest && (!widest || widths[i] > *widest))
                widest = &widths[i];
        if (!widest) break;
        --*widest;
    }
    return widths;
}

std::string Table::text() const {
    const std::vector<std::size_t> widths = columnWidths();
    std::string text;
    const auto addLines = [&](const std::vector<std::string>& cells) {
        std::vector<std::vector<std::string>> wrapped;
        std::size_t height = 0;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            wrapped.push_back(wrapText(cells[i], widths[i]));
            height = std::max(height, wrapped.back().size());
        }
        for (std::size_t y = 0; y < height; ++y) {
            std::string line(kIndent, ' ');
            for (std::size_t i = 0; i < cells.size(); ++i) {
                const std::string cell = y < wrapped[i].size() ? wrapped[i][y] : "";
                const std::string padding(widths[i] - length(cell), ' ');
                line += columns_[i].align == Align::Left ? cell + padding : padding + cell;
                if (i + 1 < cells.size()) line += std::string(kGap, ' ');
            }
            line.erase(line.find_last_not_of(' ') + 1);
            text += line + '\n';
        }
    };
    std::vector<std::string> titles;
    for (const Column& column : columns_) titles.push_back(column.title);
    addLines(titles);
    for (const std::vector<std::string>& row : rows_) addLines(row);
    return text;
}

} // namespace tessera::graph
