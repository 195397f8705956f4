#pragma once
#include <cstddef>

namespace tessera {

/// Whether row i of a table is that of value i of an enumeration with `count` values: then the table is looked up by
/// index. To be asserted where the table stands.
template <typename Table, typename Row, typename Enum>
constexpr bool isInOrder(const Table& table, Enum Row::*key, std::size_t count) {
    std::size_t row = 0;
    for (const Row& entry : table)
        if (entry.*key != Enum(row++)) return false;
    return row == count;
}

} // namespace tessera
