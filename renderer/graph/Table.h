#pragma once
#include <string>
#include <vector>

namespace tessera::graph {

/// A table of aligned columns in plain text. Cells that do not fit are wrapped, the widest column first, so that the
/// table never exceeds its width; lengths count UTF-8 characters, not bytes.
class Table {
public:
    enum class Align { Left, Right };
    enum class Cells { Break, Whole };
    explicit Table(std::size_t width) : width_(width) {}
    void addColumn(std::string title, Align align = Align::Left, Cells cells = Cells::Break);
    /// One cell per column.
    void addRow(std::vector<std::string> cells);
    /// Titles, then rows; every line is indented by two spaces and ends in a newline, without trailing spaces.
    std::string text() const;

private:
    struct Column {
        std::string title;
        Align align;
        Cells cells;
    };
    std::vector<std::size_t> columnWidths() const;
    std::size_t width_;
    std::vector<Column> columns_;
    std::vector<std::vector<std::string>> rows_;
};

/// Breaks text at spaces into lines of at most `width` characters; a longer word is cut.
std::vector<std::string> wrapText(const std::string& text, std::size_t width);

} // namespace tessera::graph
