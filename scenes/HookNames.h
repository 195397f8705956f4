#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "scenes/HookTokens.h"

/// The names that a hook declares, and how many scalars each holds.
namespace tessera::scenes {

/// Sums and products of sizes saturate here, beyond every bound.
inline constexpr std::size_t kHugeHookSize = 0xFFFF'FFFF;
std::size_t hookSum(std::size_t a, std::size_t b);
std::size_t hookProduct(std::size_t a, std::size_t b);

/// Size of a type or of a variable.
struct HookSize {
    std::size_t numbers = 1;  ///< scalars; a double counts as two
    std::size_t element = 1;  ///< scalars of an array's element; `numbers` for other types
    std::size_t product = 1;  ///< operations of a product per component: 7 for mat4
    std::size_t division = 1; ///< as `product`
    std::size_t index = 0;    ///< operations of an index, and of each variable in an array's constructor
    std::size_t structs = 0;  ///< nesting depth of structures

    void widen(const HookSize& other); ///< takes the maximum of both, by member
};

/// Reads declarations token by token. Scopes are functions, not blocks: of variables of one name in a function the
/// largest counts.
class HookNames {
public:
    explicit HookNames(std::span<const HookToken> tokens) : tokens_(tokens), levels_(1) {}

    /// Processes the token at this index; must be called in order. Returns the scalars of the arrays and structures
    /// that it declares or constructs. Throws HookFault if an array's size is neither an integer literal nor a constant
    /// that is declared once, as such a literal: scopes and arithmetic of GLSL are not reproduced.
    std::size_t take(std::size_t at);
    void leaveFunction() { locals_.clear(); }

    bool isType(std::size_t at) const; ///< false for names of members
    /// Size of a word's value in an expression: of an element for `a` in a[0], of a scalar for `a` in a.b.
    HookSize sizeAt(std::size_t at) const;

private:
    using Sizes = std::unordered_map<std::string_view, HookSize>;
    /// State within a pair of brackets, or outside of all brackets.
    struct Level {
        bool isDeclaring = false, isNameNext = false;
        HookSize type;         ///< declared type
        bool isStruct = false; ///< contains the members of a structure
        std::string_view structName;
        HookSize members{0, 0, 1, 1, 0, 1}; ///< their accumulated size
    };

    bool is(std::size_t at, std::string_view text) const { return at < tokens_.size() && tokens_[at].is(text); }
    bool isName(std::size_t at) const { return at < tokens_.size() && tokens_[at].isName(); }
    std::size_t behindArraySizes(std::size_t at) const;
    std::size_t arraySizeAt(std::size_t open) const;
    std::size_t constructed(std::size_t open) const;
    HookSize arrayOf(HookSize type, std::size_t at) const;
    HookSize typeAt(std::size_t at) const;
    std::size_t takeType(std::size_t at);
    std::size_t takeVariable(std::size_t at);
    void takeStruct(const Level& closed, std::size_t at);

    std::span<const HookToken> tokens_;
    std::vector<Level> levels_;
    bool isStructNext_ = false;
    Sizes types_, globals_, locals_; ///< structures; members, functions, globals; locals of a function
    struct Constant {
        std::int64_t value = 0; ///< 0: unknown
        std::size_t times = 0;  ///< number of declarations of the name
    };
    std::unordered_map<std::string_view, Constant> constants_;
};

} // namespace tessera::scenes
