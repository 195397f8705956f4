#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/Completion.h"

namespace tessera::app {

namespace {

/// Escapes text for single quotes, with a backslash before each character of `special`.
std::string zshText(const std::string& text, std::string_view special = "[]:\\") {
    std::string escaped;
    for (const char c : text) {
        if (special.find(c) != special.npos) escaped += '\\';
        escaped += c == '\'' ? std::string("'\\''") : std::string(1, c);
    }
    return escaped;
}

/// Value part of an _arguments specification, such as ":FILE:_files".
std::string valueSpec(const OptionText& option) {
    const ValueText& value = option.value;
    const std::string names = fmt::format("{}", fmt::join(value.names, " "));
    const std::string kind = zshText(option.type);
    if (value.isList) return fmt::format(":{}:_values -s , name {}", kind, names);
    const std::string paths = value.isFile ? "_files" : value.isFolder ? "_files -/" : "";
    if (names.empty()) return fmt::format(":{}:{}", kind, paths.empty() ? " " : paths);
    if (paths.empty()) return fmt::format(":{}:({})", kind, names);
    return fmt::format(R"zsh(:{}: _alternative "names:name:({})" "files:file:{}")zsh", kind, names, paths);
}

std::string optionSpec(const OptionText& option) {
    std::string quotedNames;
    for (const std::string& name : option.names) {
        quotedNames += quotedNames.empty() ? "" : ",";
        quotedNames += name + (!option.takesValue() ? "" : name.starts_with("--") ? "=" : "+");
    }
    if (option.names.size() > 1) quotedNames = "'{" + quotedNames + "}'";
    const std::string isOnce = option.isRepeated         ? "*"
                               : option.names.size() > 1 ? fmt::format("({})", fmt::join(option.names, " "))
                                                         : "";
    return fmt::format("'{}{}[{}]{}'", isOnce, quotedNames, zshText(option.help),
                       option.takesValue() ? valueSpec(option) : "");
}

std::string operandSpec(const OptionText& operand) {
    return fmt::format("'{}{}'", operand.isRepeated ? "*" : operand.isRequired ? "" : ":", valueSpec(operand));
}

std::string argumentsCall(const std::string& indent, const std::vector<OptionText>& options,
                          const std::vector<OptionText>& operands) {
    std::string text = indent + "_arguments";
    for (const OptionText& option : options) text += fmt::format(" \\\n{}    {}", indent, optionSpec(option));
    for (const OptionText& operand : operands) text += fmt::format(" \\\n{}    {}", indent, operandSpec(operand));
    return text;
}

} // namespace

std::string zshCompletion(const ProgramText& text) {
    std::string script = R"(#compdef tessera
# zsh completion of tessera, made by `tessera completion zsh`

_tessera() {
    local curcontext=$curcontext context state state_descr line ret=1
    local -A opt_args
    local -a commands=(
)";
    for (const CommandText& command : text.commands)
        script += fmt::format("        '{}:{}'\n", command.name, zshText(command.help, ""));
    script += "        'help:Explains a command'\n    )\n";
    script += argumentsCall("    ", text.program.options, {});
    script += R"( \
        '1:command:->command' \
        '*::argument:->argument' && ret=0
    case $state in
    command)
        _describe -t commands command commands && ret=0
        ;;
    argument)
        curcontext=${curcontext%:*}-$line[1]:
        case $line[1] in
        help)
            _describe -t commands command commands && ret=0
            ;;
)";
    for (const CommandText& command : text.commands)
        script += fmt::format("        {})\n{} && ret=0\n            ;;\n", command.name,
                              argumentsCall("            ", optionsAfter(text, command), command.operands));
    return script + R"(        esac
        ;;
    esac
    return ret
}

# The first use loads this file and calls it at once; sourced, it only registers it.
if [[ $funcstack[1] == _tessera ]]; then
    _tessera "$@"
else
    compdef _tessera tessera
fi
)";
}

} // namespace tessera::app
