#pragma once
#include <cstddef>

namespace tessera {

/// Whether row i of a table describes value i of an enumeration with `count` values, so that values index the table.
/// Assert it next to the table.
template <typename Table, typename Row, typename Enum>
constexpr bool isInOrder(const Table& table, Enum Row::*key, std::size_t count) {
    std::size_t row = 0;
    for (const Row& entry : table)
        if (entry.*key != Enum(row++)) return false;
    return row == count;
}

} // namespace tessera
