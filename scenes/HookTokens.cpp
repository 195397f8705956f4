#include "scenes/HookTokens.h"

#include <algorithm>
#include <charconv>
#include <string>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "scenes/Hook.h"

namespace tessera::scenes {
namespace hooktokens {
namespace {

using Kind = HookToken::Kind;

constexpr int kMostMacroDepth = 64;      ///< nested calls in arguments
constexpr int kMostExpressionDepth = 64; ///< nested brackets and unary operators

bool isDigit(char c) {
    return c >= '0' && c <= '9';
}
bool isOfName(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || isDigit(c);
}

std::size_t lengthOfNumber(std::string_view rest) {
    const bool isHexadecimal = rest.starts_with("0x") || rest.starts_with("0X");
    std::size_t end = 1;
    while (end < rest.size()) {
        const bool isSigned =
            !isHexadecimal && (rest[end] == '+' || rest[end] == '-') && (rest[end - 1] == 'e' || rest[end - 1] == 'E');
        if (!isSigned && !isOfName(rest[end]) && rest[end] != '.') break;
        ++end;
    }
    return end;
}

std::size_t lengthOfSign(std::string_view rest) {
    for (const std::string_view sign : {"<<=", ">>=", "++", "--", "<<", ">>", "<=", ">=", "==", "!=", "&&",
                                        "||",  "^^",  "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^="})
        if (rest.starts_with(sign)) return sign.size();
    return 1;
}

std::vector<HookToken> tokensOf(std::string_view line, std::uint32_t number) {
    std::vector<HookToken> tokens;
    bool isAfterBlank = false;
    for (std::size_t i = 0; i < line.size();) {
        const std::string_view rest = line.substr(i);
        if (rest[0] == ' ' || rest[0] == '\t' || rest[0] == '\r' || rest[0] == '\v' || rest[0] == '\f') {
            isAfterBlank = true;
            ++i;
            continue;
        }
        const bool isNumber = isDigit(rest[0]) || (rest[0] == '.' && rest.size() > 1 && isDigit(rest[1]));
        std::size_t length = 0;
        if (isNumber)
            length = lengthOfNumber(rest);
        else if (isOfName(rest[0]))
            length = std::size_t(std::ranges::find_if_not(rest, isOfName) - rest.begin());
        const Kind kind = isNumber ? Kind::Number : length > 0 ? Kind::Name : Kind::Sign;
        if (length == 0) length = lengthOfSign(rest);
        tokens.push_back({rest.substr(0, length), number, kind, isAfterBlank});
        isAfterBlank = false;
        i += length;
    }
    return tokens;
}

struct Macro {
    bool hasParameters = false;
    std::unordered_map<std::string_view, std::size_t> parameters; ///< indices by name
    std::vector<HookToken> body;
    bool isActive = false; ///< its body is being expanded
};

class Preprocessor {
public:
    std::vector<HookToken> run(std::string_view code) {
        static constexpr HookToken kVersion{"450", 0, Kind::Number};
        macros_["__VERSION__"].body = {kVersion};
        std::uint32_t number = 0;
        for (std::size_t at = 0; at < code.size();) {
            const std::size_t end = std::min(code.find('\n', at), code.size());
            const std::vector<HookToken> line = tokensOf(code.substr(at, end - at), ++number);
            at = end + 1;
            for (std::size_t i = 1; i < line.size(); ++i)
                if (line[i].is("#"))
                    throw HookFault{number, "a # stands first in its line, or drivers may find a directive that macros "
                                            "make; take it out"};
            if (!line.empty() && line[0].is("#"))
                follow(line);
            else if (isActive())
                pending_.insert(pending_.end(), line.begin(), line.end());
        }
        flush();
        return std::move(result_);
    }

private:
    struct Branch {
        bool isActive, wasActive; ///< this branch; an earlier one was, or the enclosing text is inactive
    };
    /// A source of tokens: the text or a macro's body.
    struct Source {
        std::vector<HookToken> tokens;
        std::size_t at = 0;
        Macro* macro = nullptr;
    };

    bool isActive() const { return branches_.empty() || branches_.back().isActive; }

    void charge(std::size_t tokens, std::uint32_t line) {
        made_ += tokens;
        if (made_ > kMostHookTokens)
            throw HookFault{line, fmt::format("with its macros this hook has more than {} words and signs; take macros "
                                              "out that call each other",
                                              kMostHookTokens)};
    }

    /// Expands pending text before a directive: drivers disagree about macro calls that span one.
    void flush() { expand(std::exchange(pending_, {}), result_, 0); }

    void follow(std::span<const HookToken> line) {
        if (isActive()) flush();
        if (line.size() < 2) return; // the null directive
        const std::string_view name = line[1].text;
        const std::span<const HookToken> rest = line.subspan(2);
        const std::uint32_t number = line[0].line;
        if (name == "if" || name == "ifdef" || name == "ifndef") {
            const bool isWithin = isActive();
            const bool holds =
                isWithin && (name == "if" ? isTrue(rest, number) : isDefined(rest, number) == (name == "ifdef"));
            branches_.push_back({holds, holds || !isWithin});
        } else if (name == "elif" || name == "else" || name == "endif") {
            if (branches_.empty()) throw HookFault{number, fmt::format("#{} has no #if before it; take it out", name)};
            if (name == "endif") return branches_.pop_back();
            Branch& branch = branches_.back();
            branch.isActive = !branch.wasActive && (name == "else" || isTrue(rest, number));
            branch.wasActive = branch.wasActive || branch.isActive;
        } else if (!isActive()) {
            return;
        } else if (name == "define") {
            define(rest, number);
        } else if (name == "undef") {
            if (!rest.empty()) macros_.erase(rest[0].text);
        } else if (name == "error") {
            throw HookFault{number, "the hook gives up itself, by #error"};
        } else {
            throw HookFault{number, fmt::format("#{} is no directive of GLSL; take it out", name)};
        }
    }

    bool isDefined(std::span<const HookToken> rest, std::uint32_t line) const {
        if (rest.empty() || !rest[0].isName()) throw HookFault{line, "the directive names no macro; write its name"};
        return macros_.contains(rest[0].text);
    }

    bool isTrue(std::span<const HookToken> condition, std::uint32_t line) {
        std::vector<HookToken> replaced, expanded;
        for (std::size_t i = 0; i < condition.size(); ++i) {
            if (!condition[i].is("defined")) {
                replaced.push_back(condition[i]);
                continue;
            }
            const bool isBracketed = i + 3 < condition.size() && condition[i + 1].is("(") && condition[i + 3].is(")");
            const bool holds = isDefined(condition.subspan(i + (isBracketed ? 2 : 1)), line);
            replaced.push_back({holds ? "1" : "0", line, Kind::Number});
            i += isBracketed ? 3 : 1;
        }
        expand(std::move(replaced), expanded, 0);
        const auto value = wholeNumberOf(expanded, [](std::string_view) { return std::optional<std::int64_t>(0); });
        if (!value)
            throw HookFault{line,
                            "this condition is no expression of whole numbers; write one, such as #if defined(A)"};
        return *value != 0;
    }

    void define(std::span<const HookToken> rest, std::uint32_t line) {
        if (rest.empty() || !rest[0].isName()) throw HookFault{line, "#define names no macro; write its name"};
        Macro macro;
        std::size_t at = 1;
        if (rest.size() > 1 && rest[1].is("(") && !rest[1].isAfterBlank) {
            macro.hasParameters = true;
            for (at = 2; at < rest.size() && !rest[at].is(")"); ++at) {
                const bool isComma = rest[at].is(",");
                if (isComma != (at % 2 == 1) || (!isComma && !rest[at].isName()))
                    throw HookFault{line, "the parameters of a macro are names with commas between; correct them"};
                if (!isComma && !macro.parameters.try_emplace(rest[at].text, macro.parameters.size()).second)
                    throw HookFault{line, "two parameters of this macro have one name; rename one"};
                if (macro.parameters.size() > kMostMacroParameters)
                    throw HookFault{line, fmt::format("this macro has more than {} parameters; take some out",
                                                      kMostMacroParameters)};
            }
            if (at == rest.size()) throw HookFault{line, "the parameters of this macro have no end; write )"};
            ++at;
        }
        macro.body.assign(rest.begin() + std::ptrdiff_t(at), rest.end());
        macros_.insert_or_assign(rest[0].text, std::move(macro));
    }

    /// The next token of the innermost source that has any left.
    std::optional<HookToken> peek(std::vector<Source>& sources) const {
        while (!sources.empty()) {
            if (sources.back().at < sources.back().tokens.size()) return sources.back().tokens[sources.back().at];
            if (sources.back().macro != nullptr) sources.back().macro->isActive = false;
            sources.pop_back();
        }
        return std::nullopt;
    }
    std::optional<HookToken> take(std::vector<Source>& sources) {
        const std::optional<HookToken> token = peek(sources);
        if (token) {
            ++sources.back().at;
            charge(1, token->line);
        }
        return token;
    }

    void expand(std::vector<HookToken> tokens, std::vector<HookToken>& result, int depth) {
        if (depth > kMostMacroDepth && !tokens.empty())
            throw HookFault{tokens[0].line, fmt::format("more than {} calls of macros stand in each other; write "
                                                        "functions instead",
                                                        kMostMacroDepth)};
        std::vector<Source> sources;
        sources.push_back({std::move(tokens)});
        while (std::optional<HookToken> token = take(sources)) {
            const auto found = token->isName() && !token->isExpanded ? macros_.find(token->text) : macros_.end();
            if (found == macros_.end()) {
                result.push_back(*token);
                continue;
            }
            Macro& macro = found->second;
            if (macro.isActive) {
                token->isExpanded = true;
                result.push_back(*token);
                continue;
            }
            if (macro.hasParameters) {
                const std::optional<HookToken> next = peek(sources);
                if (!next || !next->is("(")) {
                    result.push_back(*token);
                    continue;
                }
            }
            std::vector<HookToken> body = macro.hasParameters ? called(macro, *token, sources, depth) : macro.body;
            if (!macro.hasParameters) charge(body.size(), token->line);
            for (HookToken& one : body) one.line = token->line;
            macro.isActive = true;
            sources.push_back({std::move(body), 0, &macro});
        }
    }

    /// A macro's body with the following arguments substituted.
    std::vector<HookToken> called(const Macro& macro, const HookToken& name, std::vector<Source>& sources, int depth) {
        take(sources); // (
        std::vector<std::vector<HookToken>> arguments(1);
        for (std::size_t open = 1; open > 0;) {
            const std::optional<HookToken> token = take(sources);
            if (!token) throw HookFault{name.line, fmt::format("the arguments of {} have no end; write )", name.text)};
            if (token->is("(")) ++open;
            if (token->is(")") && --open == 0) break;
            if (token->is(",") && open == 1)
                arguments.emplace_back();
            else
                arguments.back().push_back(*token);
        }
        if (macro.parameters.empty() && arguments.size() == 1 && arguments[0].empty()) arguments.clear();
        if (arguments.size() != macro.parameters.size())
            throw HookFault{name.line, fmt::format("the macro {} takes {} arguments, not {}; give as many", name.text,
                                                   macro.parameters.size(), arguments.size())};
        std::vector<std::vector<HookToken>> expanded(arguments.size());
        for (std::size_t i = 0; i < arguments.size(); ++i) expand(std::move(arguments[i]), expanded[i], depth + 1);
        std::vector<HookToken> body;
        for (const HookToken& token : macro.body) {
            charge(1, name.line);
            const auto parameter = macro.parameters.find(token.text);
            if (parameter == macro.parameters.end()) {
                body.push_back(token);
                continue;
            }
            const std::vector<HookToken>& argument = expanded[parameter->second];
            charge(argument.size(), name.line);
            body.insert(body.end(), argument.begin(), argument.end());
        }
        return body;
    }

    std::unordered_map<std::string_view, Macro> macros_;
    std::vector<Branch> branches_;
    std::vector<HookToken> pending_; ///< lines since the last directive
    std::vector<HookToken> result_;
    std::size_t made_ = 0;
};

/// Evaluates integer expressions by precedence. Overflow wraps, as in GLSL.
class WholeNumbers {
public:
    using ValueOf = std::function<std::optional<std::int64_t>(std::string_view name)>;
    WholeNumbers(std::span<const HookToken> tokens, const ValueOf& valueOf) : tokens_(tokens), valueOf_(valueOf) {}

    std::optional<std::int64_t> all() {
        const std::optional<std::int64_t> value = binary(0);
        return at_ == tokens_.size() ? value : std::nullopt;
    }

private:
    struct Operator {
        std::string_view sign;
        int rank;
    };
    static int rankOf(std::string_view sign) {
        constexpr Operator kOperators[] = {{"||", 1}, {"&&", 2}, {"|", 3}, {"^", 4},  {"&", 5},  {"==", 6},
                                           {"!=", 6}, {"<", 7},  {">", 7}, {"<=", 7}, {">=", 7}, {"<<", 8},
                                           {">>", 8}, {"+", 9},  {"-", 9}, {"*", 10}, {"/", 10}, {"%", 10}};
        const auto* found = std::ranges::find(kOperators, sign, &Operator::sign);
        return found == std::end(kOperators) ? 0 : found->rank;
    }
    static std::optional<std::int64_t> applied(std::string_view sign, std::int64_t a, std::int64_t b) {
        const auto x = std::uint64_t(a), y = std::uint64_t(b);
        if (sign == "||") return a != 0 || b != 0;
        if (sign == "&&") return a != 0 && b != 0;
        if (sign == "|") return a | b;
        if (sign == "^") return a ^ b;
        if (sign == "&") return a & b;
        if (sign == "==") return a == b;
        if (sign == "!=") return a != b;
        if (sign == "<") return a < b;
        if (sign == ">") return a > b;
        if (sign == "<=") return a <= b;
        if (sign == ">=") return a >= b;
        if (sign == "<<" || sign == ">>") {
            if (b < 0 || b > 31) return std::nullopt;
            return sign == "<<" ? std::int64_t(x << y) : a >> b;
        }
        if (sign == "+") return std::int64_t(x + y);
        if (sign == "-") return std::int64_t(x - y);
        if (sign == "*") return std::int64_t(x * y);
        if (b == 0 || b == -1) return std::nullopt; // -1: the minimum has no negation
        return sign == "/" ? a / b : a % b;
    }

    std::optional<std::int64_t> binary(int above) {
        std::optional<std::int64_t> value = unary();
        while (value && at_ < tokens_.size() && rankOf(tokens_[at_].text) > above) {
            const std::string_view sign = tokens_[at_++].text;
            const std::optional<std::int64_t> other = binary(rankOf(sign));
            value = other ? applied(sign, *value, *other) : std::nullopt;
        }
        return value;
    }

    std::optional<std::int64_t> unary() {
        if (at_ == tokens_.size() || depth_ == kMostExpressionDepth) return std::nullopt;
        const HookToken& token = tokens_[at_++];
        if (token.kind == Kind::Number) return numberOf(token.text);
        if (token.isName()) return valueOf_(token.text);
        ++depth_;
        std::optional<std::int64_t> value;
        if (token.is("(")) {
            value = binary(0);
            if (at_ == tokens_.size() || !tokens_[at_++].is(")")) value.reset();
        } else if (token.is("!") || token.is("~") || token.is("-") || token.is("+")) {
            value = unary();
            if (value && token.is("!")) value = *value == 0;
            if (value && token.is("~")) value = ~*value;
            if (value && token.is("-")) value = std::int64_t(0 - std::uint64_t(*value));
        }
        --depth_;
        return value;
    }

    static std::optional<std::int64_t> numberOf(std::string_view text) {
        if (text.ends_with('u') || text.ends_with('U')) text.remove_suffix(1);
        int base = 10;
        if (text.starts_with("0x") || text.starts_with("0X")) {
            base = 16;
            text.remove_prefix(2);
        } else if (text.size() > 1 && text[0] == '0') {
            base = 8;
        }
        std::int64_t value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
        if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
        return value;
    }

    std::span<const HookToken> tokens_;
    const ValueOf& valueOf_;
    std::size_t at_ = 0;
    int depth_ = 0;
};

} // namespace
} // namespace hooktokens

std::size_t behindBracket(std::span<const HookToken> tokens, std::size_t open) {
    std::size_t depth = 0;
    for (std::size_t i = open; i < tokens.size(); ++i) {
        depth += opens(tokens[i]);
        if (closes(tokens[i]) && --depth == 0) return i + 1;
    }
    return tokens.size();
}

std::vector<HookToken> expandedTokens(std::string_view code) {
    return hooktokens::Preprocessor().run(code);
}

std::optional<std::int64_t>
wholeNumberOf(std::span<const HookToken> expression,
              const std::function<std::optional<std::int64_t>(std::string_view name)>& valueOf) {
    return hooktokens::WholeNumbers(expression, valueOf).all();
}

} // namespace tessera::scenes
