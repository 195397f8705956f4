#include "scenes/HookLoops.h"

#include <optional>
#include <vector>

#include "scenes/Hook.h"

namespace tessera::scenes {
namespace {

/// The token range of the condition of the loop at `loop`; none if it is no valid loop.
struct Condition {
    std::size_t begin = 0, end = 0;
};
std::optional<Condition> conditionOf(std::span<const HookToken> tokens, std::size_t loop) {
    if (loop + 1 >= tokens.size() || !tokens[loop + 1].is("(")) return std::nullopt;
    std::vector<std::size_t> ends{loop + 1}; // ( ; ; )
    const std::size_t close = behindBracket(tokens, loop + 1) - 1;
    for (std::size_t i = loop + 2; i < close; i = opens(tokens[i]) ? behindBracket(tokens, i) : i + 1)
        if (tokens[i].is(";")) ends.push_back(i);
    ends.push_back(close);
    if (tokens[loop].is("for")) return ends.size() == 4 ? std::optional(Condition{ends[1] + 1, ends[2]}) : std::nullopt;
    return ends.size() == 2 && ends[0] + 1 < ends[1] ? std::optional(Condition{ends[0] + 1, ends[1]}) : std::nullopt;
}

} // namespace

std::map<std::size_t, std::string> hookLoopGuards(std::span<const HookToken> tokens) {
    std::map<std::size_t, std::string> guards;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        if (!tokens[i].is("for") && !tokens[i].is("while")) continue;
        const std::optional<Condition> found = conditionOf(tokens, i);
        if (!found) continue;
        const auto [begin, end] = *found;
        if (begin + 1 < end && tokens[begin].isName() && tokens[begin + 1].isName())
            throw HookFault{tokens[begin].line, "the condition of a loop declares a variable; declare it before the "
                                                "loop"};
        guards[begin] += begin == end ? "hookGoesOn() " : "( ";
        if (begin < end) guards[end] += ") && hookGoesOn() ";
    }
    return guards;
}

} // namespace tessera::scenes
