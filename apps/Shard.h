#pragma once
#include <cstddef>
#include <string>

namespace tessera::app {

/// Part `index` of `count`, counted from 1, of work divided into pieces.
struct Shard {
    int index = 1, count = 1;
    /// Whether the shard contains a piece, counted from 0: every `count`-th, beginning with the `index`-th.
    bool has(std::size_t piece) const { return piece % std::size_t(count) == std::size_t(index) - 1; }
};

/// Parses "2/5"; an empty text is all of the work. Throws InputError that names --shard.
Shard shardNamed(const std::string& text);

} // namespace tessera::app
