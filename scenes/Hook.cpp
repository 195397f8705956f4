#include "scenes/Hook.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/Error.h"
#include "base/HookPrefix.h"
#include "scenes/HookBounds.h"
#include "scenes/HookLoops.h"
#include "scenes/HookTokens.h"
#include "scenes/HookWords.h"

namespace tessera::scenes {
namespace {

/// Words that hooks must not contain outside of comments, and the reason.
enum class Refused { Word, Beginning, Directive };
struct RefusedWord {
    Refused what; ///< the exact word, a prefix, or a directive behind a #
    std::string_view word, why;
};
constexpr std::string_view kDiffersBetweenPixels = "differences between pixels differ between passes; take it out";
constexpr RefusedWord kRefusedWords[] = {
    {Refused::Directive, "include",
     "a hook is one file, and shader files of the program are no part of it; take the #include out"},
    {Refused::Directive, "version", "the program gives the version of GLSL; take it out"},
    {Refused::Directive, "extension", "the program gives extensions; take it out"},
    {Refused::Directive, "line", "the program numbers lines, so that messages name the right one; take it out"},
    {Refused::Directive, "pragma", "the program gives pragmas; take it out"},
    {Refused::Word, "discard",
     "a hook makes no holes, which passes that store depth alone would not have; use an alpha mask"},
    {Refused::Word, "gl_FragDepth", "a hook moves no depth, which other passes would not move; take it out"},
    {Refused::Beginning, "gl_", "values of a pixel or a vertex differ between passes; use the inputs"},
    {Refused::Word, "layout", "a hook binds nothing; take it out, and declare numbers as parameters of the scene"},
    {Refused::Word, "uniform", "a hook binds nothing; declare numbers as parameters of the scene"},
    {Refused::Word, "buffer", "a hook binds nothing; take it out"},
    {Refused::Word, "shared", "points share no memory; take it out"},
    // Prefixes: variants end in Fine or Coarse.
    {Refused::Beginning, "dFdx", kDiffersBetweenPixels},
    {Refused::Beginning, "dFdy", kDiffersBetweenPixels},
    {Refused::Beginning, "fwidth", kDiffersBetweenPixels},
    {Refused::Beginning, "interpolateAt", kDiffersBetweenPixels},
};

bool isRefused(const RefusedWord& refused, std::string_view word, bool isDirective) {
    switch (refused.what) {
    case Refused::Word:
        return word == refused.word;
    case Refused::Beginning:
        return word.starts_with(refused.word);
    case Refused::Directive:
        return word == refused.word && isDirective;
    }
    return false;
}

constexpr unsigned char kLastOfAscii = 0x7f;
constexpr std::string_view kSurfaceFunction = "hookSurface", kVertexFunction = "hookVertex";

bool isLetter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
bool isDigit(char c) {
    return c >= '0' && c <= '9';
}
bool isOfWord(char c) {
    return isLetter(c) || isDigit(c) || c == '_';
}
/// The word characters from a position on; empty if there are none.
std::string_view wordAt(std::string_view code, std::size_t begin) {
    std::size_t end = begin;
    while (end < code.size() && isOfWord(code[end])) ++end;
    return code.substr(begin, end - begin);
}

/// Replaces comments by spaces; line breaks stay. `open` receives the position of an unterminated comment.
std::string withoutComments(std::string_view text, std::optional<std::size_t>* open = nullptr) {
    std::string code(text);
    enum class In { Code, Line, Block } in = In::Code;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < code.size(); ++i) {
        const std::string_view pair = text.substr(i, 2);
        if (in == In::Code && pair == "//") in = In::Line;
        if (in == In::Code && pair == "/*") {
            in = In::Block;
            begin = i;
            code[i++] = ' ';
            code[i] = ' ';
            continue;
        }
        if (in == In::Block && pair == "*/") {
            in = In::Code;
            code[i++] = ' ';
            code[i] = ' ';
            continue;
        }
        if (in == In::Line && code[i] == '\n') in = In::Code;
        if (in != In::Code && code[i] != '\n') code[i] = ' ';
    }
    if (open != nullptr && in == In::Block) *open = begin;
    return code;
}

/// Distinguishes the member names of structures, which get no prefix, from their types and array sizes.
class Members {
public:
    /// Whether a token is a member's name. Must be called for all tokens in order.
    bool isMember(const HookToken& token) {
        if (token.is("struct")) state_ = State::Named;
        if (state_ == State::Outside) return false;
        if (token.is("{")) state_ = State::Type;
        if (token.is("}") || (state_ == State::Named && token.is(";"))) state_ = State::Outside;
        if (token.is("[")) ++brackets_;
        if (token.is("]") && brackets_ > 0) --brackets_;
        if (token.is(";") && state_ == State::Member) state_ = State::Type;
        if (!token.isName() || brackets_ > 0 || isHookQualifier(token.text)) return false;
        if (state_ == State::Type) {
            state_ = State::Member;
            return false;
        }
        return state_ == State::Member;
    }

private:
    enum class State { Outside, Named, Type, Member } state_ = State::Outside;
    std::size_t brackets_ = 0;
};

} // namespace

bool Hook::changes(std::size_t material) const {
    return std::ranges::binary_search(materials, int(material));
}

bool isHookParameterName(std::string_view name) {
    constexpr std::size_t kMostLetters = 32;
    return !name.empty() && name.size() <= kMostLetters && isLetter(name.front()) && name != "timeSeconds" &&
           std::ranges::all_of(name, [](char c) { return isLetter(c) || isDigit(c); });
}

void setHookValue(Hook& hook, const HookValue& value) {
    const auto found = std::ranges::find(hook.parameters, value.name, &HookParameter::name);
    if (found == hook.parameters.end()) {
        std::vector<std::string_view> names;
        for (const HookParameter& parameter : hook.parameters) names.push_back(parameter.name);
        throw InputError(
            fmt::format("its hook has no parameter '{}'; {}", value.name,
                        names.empty() ? "it has none" : fmt::format("valid are {}", fmt::join(names, ", "))));
    }
    if (!found->allows(value.value))
        throw InputError(fmt::format("the parameter '{}' of its hook cannot be {:g}; it lies between {:g} and {:g}",
                                     value.name, value.value, found->least, found->most));
    found->value = value.value;
}

HookFunctions hookFunctions(std::string_view text) {
    const std::string code = withoutComments(text);
    HookFunctions functions;
    for (std::size_t i = 0; i < code.size();) {
        const std::string_view word = wordAt(code, i);
        functions.surface = functions.surface || word == kSurfaceFunction;
        functions.vertex = functions.vertex || word == kVertexFunction;
        i += std::max(word.size(), std::size_t(1));
    }
    return functions;
}

std::optional<HookFault> hookFault(std::string_view text) {
    if (text.size() > kMostHookBytes)
        return HookFault{1, fmt::format("it has {} bytes; a hook has at most {}", text.size(), kMostHookBytes)};
    std::optional<std::size_t> openComment;
    const std::string code = withoutComments(text, &openComment);
    std::vector<std::size_t> conditionals; // lines of open #if directives
    std::size_t line = 1;
    char before = '\n'; // the last non-blank character
    for (std::size_t i = 0; i < code.size();) {
        const char c = code[i];
        if (c == '\0') return HookFault{line, "a zero byte is no text; give a file of GLSL"};
        // Within comments as well, since these may hide a comment's end.
        const std::string_view rest = text.substr(i);
        if (rest.starts_with('\r') && !rest.starts_with("\r\n"))
            return HookFault{line, "a carriage return alone ends a line for some drivers only; save the file with the "
                                   "line ends of Unix or Windows"};
        const bool endsLine = rest.starts_with("\\\n") || rest.starts_with("\\\r\n");
        if (c == '\\' || endsLine)
            return HookFault{line, "a backslash joins lines, so that messages name the wrong one; take it out"};
        if (static_cast<unsigned char>(c) > kLastOfAscii)
            return HookFault{line, "outside of comments GLSL has the letters of ASCII alone; take others out, and the "
                                   "byte order mark that some editors begin a file with"};
        if (code.compare(i, 2, "##") == 0) return HookFault{line, "## makes words that nothing checks; write them out"};
        const std::string_view word = wordAt(code, i);
        if (word.empty()) {
            if (c == '\n') ++line;
            if (c != ' ' && c != '\t' && c != '\r') before = c;
            ++i;
            continue;
        }
        for (const RefusedWord& refused : kRefusedWords)
            if (isRefused(refused, word, before == '#'))
                return HookFault{line, fmt::format("{}: {}", word, refused.why)};
        if (before == '#' && (word == "if" || word == "ifdef" || word == "ifndef")) {
            conditionals.push_back(line);
        } else if (before == '#' && (word == "elif" || word == "else" || word == "endif")) {
            if (conditionals.empty())
                return HookFault{line, fmt::format("#{} has no #if before it; take it out", word)};
            if (word == "endif") conditionals.pop_back();
        }
        before = word.back();
        i += word.size();
    }
    // Otherwise the comment would swallow the rest of the shader that includes the text.
    if (openComment)
        return HookFault{std::size_t(1 + std::ranges::count(text.substr(0, *openComment), '\n')),
                         "the comment that begins here has no end; write */"};
    if (!conditionals.empty()) return HookFault{conditionals.back(), "this #if has no #endif; write one"};
    const HookFunctions functions = hookFunctions(text);
    if (!functions.surface && !functions.vertex)
        return HookFault{1, "it defines neither hookSurface nor hookVertex; write void hookSurface(inout HookedSurface "
                            "surface, HookInputs inputs)"};
    try {
        const std::vector<HookToken> tokens = expandedTokens(code);
        requireBounds(tokens);
        hookLoopGuards(tokens);
    } catch (const HookFault& fault) {
        return fault;
    }
    return std::nullopt;
}

std::string hookProgramText(const std::string& file, std::string_view text) {
    requireHook(file, text);
    const std::string code = withoutComments(text);
    std::string written;
    std::uint32_t line = 1;
    bool isField = false; // behind a dot
    Members members;
    const std::vector<HookToken> tokens = expandedTokens(code);
    const auto guards = hookLoopGuards(tokens);
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        const HookToken& token = tokens[i];
        for (; line < token.line; ++line) written += '\n';
        if (const auto guard = guards.find(i); guard != guards.end()) written += guard->second;
        const bool isMember = members.isMember(token);
        if (token.isName() && !isField && !isMember && !isHookWord(token.text)) written += kHookPrefix;
        written.append(token.text) += ' ';
        isField = token.is(".");
    }
    return written + '\n';
}

void requireHook(const std::string& file, std::string_view text) {
    if (const std::optional<HookFault> fault = hookFault(text))
        throw InputError(fmt::format("{}:{}: {}", file, fault->line, fault->why));
}

} // namespace tessera::scenes
