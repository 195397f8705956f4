#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "scenes/HookTokens.h"

/// The names that a hook declares, and how many numbers they stand for.
namespace tessera::scenes {

/// Sums and products of sizes end here, beyond every bound.
inline constexpr std::size_t kHugeHookSize = 0xFFFF'FFFF;
std::size_t hookSum(std::size_t a, std::size_t b);
std::size_t hookProduct(std::size_t a, std::size_t b);

/// Size of a type or of a variable.
struct HookSize {
    std::size_t numbers = 1;  ///< a double counts as two
    std::size_t element = 1;  ///< numbers of an array's element; of other types as `numbers`
    std::size_t product = 1;  ///< operations of a product for each of its numbers: 7 for mat4
    std::size_t division = 1; ///< as `product`
    std::size_t index = 0;    ///< operations of an index, and of each variable in an array's constructor
    std::size_t structs = 0;  ///< depth of structures in structures

    void widen(const HookSize& other); ///< to the larger of both, in each member
};

/// Reads declarations token by token. It knows functions, but no blocks: of variables of one name in a function the
/// largest counts.
class HookNames {
public:
    explicit HookNames(std::span<const HookToken> tokens) : tokens_(tokens), levels_(1) {}

    /// Takes the token at this place; the places are given in order. Returns the numbers of the arrays and structures
    /// that it declares or constructs. Throws HookFault where an array's size is neither one whole number nor the name
    /// of a constant that is declared once, as one whole number: scopes and arithmetic of GLSL are not reproduced.
    std::size_t take(std::size_t at);
    void leaveFunction() { locals_.clear(); }

    bool isType(std::size_t at) const; ///< not as the name of a member
    /// Size of the value that a word stands for in an expression: of an element for `a` in a[0], of a number for `a` in
    /// a.b.
    HookSize sizeAt(std::size_t at) const;

private:
    using Sizes = std::unordered_map<std::string_view, HookSize>;
    /// Tokens in one pair of brackets, or outside of all.
    struct Level {
        bool isDeclaring = false, isNameNext = false;
        HookSize type;         ///< of the declaration
        bool isStruct = false; ///< holds the members of one
        std::string_view structName;
        HookSize members{0, 0, 1, 1, 0, 1}; ///< their sum
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
    Sizes types_, globals_, locals_; ///< structures; members, functions and variables; variables of a function
    struct Constant {
        std::int64_t value = 0; ///< 0: unknown
        std::size_t times = 0;  ///< declarations of the name
    };
    std::unordered_map<std::string_view, Constant> constants_;
};

} // namespace tessera::scenes
