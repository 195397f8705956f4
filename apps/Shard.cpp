#include "apps/Shard.h"

#include <charconv>

#include <fmt/format.h>

#include "base/Error.h"
#include "validation/bench/BenchStore.h"

namespace tessera::app {

Shard shardNamed(const std::string& text) {
    if (text.empty()) return {};
    Shard shard;
    const char* const end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, shard.index);
    if (first.ec == std::errc() && first.ptr != end && *first.ptr == '/') {
        const auto second = std::from_chars(first.ptr + 1, end, shard.count);
        if (second.ec == std::errc() && second.ptr == end && shard.index >= 1 && shard.index <= shard.count &&
            shard.count <= validation::kMostShards)
            return shard;
    }
    throw InputError(fmt::format("--shard {}: give a shard and how many there are, such as 1/4, counted from 1", text));
}

} // namespace tessera::app
