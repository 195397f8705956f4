#pragma once
#include <cstddef>
#include <string>

namespace tessera::app {

/// Part `index` of `count`, counted from 1, of work that is cut into pieces.
struct Shard {
    int index = 1, count = 1;
    /// Whether it has a piece, counted from 0: every `count`-th, beginning with the `index`-th.
    bool has(std::size_t piece) const { return piece % std::size_t(count) == std::size_t(index) - 1; }
};

/// "2/5"; all of the work where the text is empty. Throws InputError that names --shard.
Shard shardNamed(const std::string& text);

} // namespace tessera::app
