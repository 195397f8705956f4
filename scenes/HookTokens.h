#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

/// The text of a hook as GLSL's preprocessor leaves it, and its numbers.
namespace tessera::scenes {

/// Tokens that the text and its macros may make on the way, arguments included.
inline constexpr std::size_t kMostHookTokens = 1'000'000;
inline constexpr std::size_t kMostMacroParameters = 255;

struct HookToken {
    enum class Kind : std::uint8_t { Name, Number, Sign };
    std::string_view text; ///< of the text that was given
    std::uint32_t line;    ///< from 1; of a macro's tokens the line that calls it
    Kind kind;
    bool isAfterBlank = false;
    bool isExpanded = false; ///< a macro's name inside of that macro, which stays

    bool is(std::string_view other) const { return text == other; }
    bool isName() const { return kind == Kind::Name; }
};
inline bool opens(const HookToken& token) {
    return token.is("(") || token.is("[") || token.is("{");
}
inline bool closes(const HookToken& token) {
    return token.is(")") || token.is("]") || token.is("}");
}
/// The place behind the bracket that opens here; the number of tokens where it does not close.
std::size_t behindBracket(std::span<const HookToken> tokens, std::size_t open);

/// The tokens that a driver would see: without directives, inactive branches and macros. Only the text's own macros are
/// defined, and __VERSION__. `code` has no comments and no joined lines, and must outlive the result. Throws HookFault
/// where it is no such text, and where macros make more than kMostHookTokens; no more than those are ever in memory.
std::vector<HookToken> expandedTokens(std::string_view code);

/// The value of an expression of whole numbers; none where it has anything else. `valueOf` gives that of a name.
std::optional<std::int64_t>
wholeNumberOf(std::span<const HookToken> expression,
              const std::function<std::optional<std::int64_t>(std::string_view name)>& valueOf);

} // namespace tessera::scenes
