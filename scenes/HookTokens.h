#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

/// Preprocessed tokens of a hook's text, and evaluation of its integer expressions.
namespace tessera::scenes {

/// Maximum number of tokens produced during expansion, arguments included.
inline constexpr std::size_t kMostHookTokens = 1'000'000;
inline constexpr std::size_t kMostMacroParameters = 255;

struct HookToken {
    enum class Kind : std::uint8_t { Name, Number, Sign };
    std::string_view text; ///< view of the given text
    std::uint32_t line;    ///< from 1; for expanded tokens that of the macro call
    Kind kind;
    bool isAfterBlank = false;
    bool isExpanded = false; ///< a macro's name inside its own expansion, which stays

    bool is(std::string_view other) const { return text == other; }
    bool isName() const { return kind == Kind::Name; }
};
inline bool opens(const HookToken& token) {
    return token.is("(") || token.is("[") || token.is("{");
}
inline bool closes(const HookToken& token) {
    return token.is(")") || token.is("]") || token.is("}");
}
/// The index behind the bracket that closes the one at `open`; the number of tokens if it is not closed.
std::size_t behindBracket(std::span<const HookToken> tokens, std::size_t open);

/// Preprocesses `code`: returns the tokens without directives, inactive branches and macros. Only __VERSION__ is
/// predefined. `code` has no comments and no joined lines, and must outlive the result. Throws HookFault for errors,
/// and if macros produce more than kMostHookTokens, which also bounds the memory.
std::vector<HookToken> expandedTokens(std::string_view code);

/// Evaluates an integer expression; none if it contains anything else. `valueOf` returns the value of a name.
std::optional<std::int64_t>
wholeNumberOf(std::span<const HookToken> expression,
              const std::function<std::optional<std::int64_t>(std::string_view name)>& valueOf);

} // namespace tessera::scenes
