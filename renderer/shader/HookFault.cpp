#include "renderer/shader/HookFault.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <regex>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/HookPrefix.h"
#include "renderer/shader/LineScanner.h"

namespace tessera::shader {
namespace {

constexpr const char* kEmptyHook = "lib/material/empty_hook.glsl";
constexpr const char* kHookRemedy =
    "GLSL has no recursion, and a hook declares no in or out variables; write void hookSurface(inout HookedSurface "
    "surface, HookInputs inputs), void hookVertex(inout vec3 positionOS, inout vec3 normalOS, vec2 uv) or both, each "
    "once and outside of conditionals";

std::string hookDefine(const ProgramDesc& desc, std::string_view name) {
    const auto found = std::ranges::find(desc.defines, name, &Defines::value_type::first);
    return found == desc.defines.end() ? "" : found->second;
}

constexpr const char* kNamesRemedy = "a hook may use GLSL without textures and derivatives, the names that "
                                     "docs/hooks.md lists, and names that it declares "
                                     "itself; other names of the program are hidden";

bool isInName(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// A log without warnings, most of which concern the program's other files. Strips kHookPrefix from the hook's names.
std::string errorsOf(std::string_view log) {
    std::string errors;
    std::istringstream lines{std::string(log)};
    for (std::string line; std::getline(lines, line);)
        if (line.find(": warning") == std::string::npos) errors += (errors.empty() ? "" : "\n") + line;
    for (std::size_t at = errors.find(kHookPrefix); at != std::string::npos; at = errors.find(kHookPrefix, at))
        if (at == 0 || !isInName(errors[at - 1])) // file names may contain the prefix too
            errors.erase(at, kHookPrefix.size());
        else
            ++at;
    return errors;
}

/// Position of a whole-word name in a line, searched from a position on; npos: not found.
std::size_t placeOfName(std::string_view line, std::string_view name, std::size_t from = 0) {
    for (std::size_t at = line.find(name, from); at != std::string_view::npos; at = line.find(name, at + 1)) {
        const std::size_t end = at + name.size();
        if ((at == 0 || !isInName(line[at - 1])) && (end == line.size() || !isInName(line[end]))) return at;
    }
    return std::string_view::npos;
}

/// The names quoted in errors, functions without parameters: `float f(int)' by Mesa, "f" by NVIDIA, 'f' by glslang.
std::vector<std::string> quotedNames(std::string_view errors) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < errors.size(); ++i) {
        const char open = errors[i];
        const bool isQuote = open == '`' || open == '"' || (open == '\'' && (i == 0 || !isInName(errors[i - 1])));
        if (!isQuote) continue;
        const std::size_t end = errors.find_first_of(open == '"' ? "\"\n" : "'\n", i + 1);
        if (end == std::string_view::npos || errors[end] == '\n') continue;
        std::string_view piece = errors.substr(i + 1, end - i - 1);
        piece = piece.substr(0, piece.find('('));
        std::size_t begin = piece.size();
        while (begin > 0 && isInName(piece[begin - 1])) --begin;
        if (begin < piece.size()) names.emplace_back(piece.substr(begin));
        i = end;
    }
    return names;
}

/// A file's lines without comments; empty if the file is missing.
std::vector<std::string> codeLines(const SourceTree& tree, std::string_view path) {
    std::vector<std::string> code;
    std::istringstream lines(tree.read(path).value_or(""));
    LineScanner scanner;
    for (std::string line; std::getline(lines, line);) {
        scanner.next(line);
        code.push_back(scanner.code());
    }
    return code;
}

/// Line number, from 1, of the first of the names that occurs in the code.
std::optional<std::size_t> lineOfFirst(const std::vector<std::string>& names, const std::vector<std::string>& code) {
    for (const std::string& name : names)
        for (std::size_t i = 0; i < code.size(); ++i)
            if (placeOfName(code[i], name) != std::string_view::npos) return i + 1;
    return std::nullopt;
}

bool isUsedAsField(const std::string& name, const std::vector<std::string>& code) {
    return std::ranges::any_of(code, [&](const std::string& line) {
        for (std::size_t at = placeOfName(line, name); at != std::string_view::npos;
             at = placeOfName(line, name, at + 1))
            if (at > 0 && line[at - 1] == '.') return true;
        return false;
    });
}

/// "HookedSurface has color, emission; HookInputs has uv; hook has timeSeconds, wind", parsed from the declarations.
std::string hookFields(const SourceTree& tree, const ProgramDesc& desc) {
    const std::string declared = fmt::format("{}", fmt::join(codeLines(tree, kHookInterface), "\n"));
    static const std::regex structure(R"(struct\s+(\w+)\s*\{([^}]*)\})"), field(R"((\w+)\s*;)");
    const auto matches = [](const std::string& text, const std::regex& pattern) {
        return std::vector<std::smatch>(std::sregex_iterator(text.begin(), text.end(), pattern),
                                        std::sregex_iterator());
    };
    std::string text;
    for (const std::smatch& found : matches(declared, structure)) {
        const std::string body = found.str(2);
        std::vector<std::string> names;
        for (const std::smatch& one : matches(body, field)) names.push_back(one.str(1));
        text += fmt::format("{} has {}; ", found.str(1), fmt::join(names, ", "));
    }
    text += "hook has timeSeconds";
    std::istringstream parameters(hookDefine(desc, kHookParameters));
    for (std::string name; parameters >> name;) text += ", " + name;
    return text;
}

} // namespace

std::string hookFileOf(const ProgramDesc& desc) {
    return hookDefine(desc, kHookFile);
}

ProgramDesc withEmptyHook(const ProgramDesc& desc) {
    ProgramDesc empty = desc;
    for (auto& [name, value] : empty.defines) {
        if (name == kHookFile) value = kEmptyHook;
        if (name == kHookParameters) value.clear();
    }
    return empty;
}

bool namesHook(const ProgramDesc& desc, std::string_view log) {
    return errorsOf(log).find(hookFileOf(desc)) != std::string::npos;
}

std::string hookFaultText(const SourceTree& tree, const ProgramDesc& desc, std::string_view log) {
    const std::string hook = hookFileOf(desc), errors = errorsOf(log);
    const std::vector<std::string> names = quotedNames(errors), code = codeLines(tree, hook);
    const bool isPlaced = namesHook(desc, log);
    const std::optional<std::size_t> line = isPlaced ? std::nullopt : lineOfFirst(names, code);
    std::string text = fmt::format("{}{}: the driver refuses this hook: {}", hook,
                                   line ? fmt::format(":{}", *line) : std::string(), errors);
    if (!isPlaced) text += fmt::format("\n{}", kHookRemedy);
    const bool isUnknown = errors.find("undeclared") != std::string::npos || // Mesa, glslang
                           errors.find("undefined") != std::string::npos ||  // NVIDIA
                           errors.find("no function with name") != std::string::npos;
    if (isPlaced && isUnknown) text += fmt::format("\n{}", kNamesRemedy);
    if (std::ranges::any_of(names, [&](const std::string& name) { return isUsedAsField(name, code); }))
        text += "\n" + hookFields(tree, desc);
    return text;
}

} // namespace tessera::shader
