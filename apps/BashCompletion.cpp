#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/Completion.h"

namespace tessera::app {

namespace {

/// Completion candidates of a value, as assignments to the script's variables.
std::string offers(const ValueText& value) {
    std::string text;
    if (!value.names.empty()) text += fmt::format(" names='{}'", fmt::join(value.names, " "));
    if (value.isFile) text += " paths=file";
    if (value.isFolder) text += " paths=directory";
    if (value.isList) text += " isList=yes";
    return text;
}

/// Pattern of a shell `case`: a | b.
std::string casePattern(const std::vector<std::string>& names) {
    return fmt::format("{}", fmt::join(names, " | "));
}

/// Branch of the script's `case` for one command: its options, their values, and the values of `operand`.
std::string bashRow(const std::string& name, const std::vector<OptionText>& options, const ValueText& operand) {
    std::vector<std::string> all;
    for (const OptionText& option : options) all.insert(all.end(), option.names.begin(), option.names.end());
    std::string text = fmt::format("    {})\n        options='{}'\n        case $previous in\n",
                                   name.empty() ? "''" : name, fmt::join(all, " "));
    for (const OptionText& option : options)
        if (option.takesValue())
            text += fmt::format("        {}) isValue=yes{} ;;\n", casePattern(option.names), offers(option.value));
    if (const std::string own = offers(operand); !own.empty()) text += fmt::format("        *){} ;;\n", own);
    return text + "        esac\n        ;;\n";
}

constexpr const char* kBashHead = R"(# bash completion of tessera, made by `tessera completion bash`

_tessera() {
    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command='' i
    local options='' names='' paths='' isValue='' isList='' before=''
    COMPREPLY=()
    # Bash takes --size=WxH for three words.
    if [[ $current == = ]]; then
        current=''
    elif [[ $previous == = ]]; then
        previous=${COMP_WORDS[COMP_CWORD - 2]}
    fi
)";

constexpr const char* kBashTail = R"(    esac
    if [[ -z $isValue && $current == -* ]]; then
        names=$options paths=''
    elif [[ $isList && $current == *,* ]]; then
        before=${current%,*},
        current=${current##*,}
    fi
    mapfile -t COMPREPLY < <(
        [[ -z $names ]] || compgen -P "$before" -W "$names" -- "$current"
        [[ -z $paths ]] || compgen -A "$paths" -- "$current"
    )
    # Then the shell puts a slash behind folders, and quotes what needs it. Elsewhere than at a prompt it refuses.
    [[ -z $paths ]] || compopt -o filenames 2>/dev/null || true
}

complete -F _tessera tessera
)";

} // namespace

std::string bashCompletion(const ProgramText& text) {
    std::vector<std::string> withValue;
    for (const OptionText& option : text.program.options)
        if (option.takesValue()) withValue.insert(withValue.end(), option.names.begin(), option.names.end());
    std::string script = kBashHead;
    script += fmt::format(R"(    for ((i = 1; i < COMP_CWORD; i++)); do
        case ${{COMP_WORDS[i]}} in
        {})
            [[ ${{COMP_WORDS[i + 1]}} != = ]] || ((i++))
            ((i++))
            ;;
        -*) ;;
        *)
            command=${{COMP_WORDS[i]}}
            break
            ;;
        esac
    done
    case $command in
)",
                          casePattern(withValue));
    ValueText commands;
    for (const CommandText& command : text.commands) commands.names.push_back(command.name);
    script += bashRow("help", {}, commands);
    commands.names.emplace_back("help");
    script += bashRow("", text.program.options, commands);
    for (const CommandText& command : text.commands) // all operands of a command are of one kind
        script += bashRow(command.name, optionsAfter(text, command),
                          command.operands.empty() ? ValueText() : command.operands.front().value);
    return script + kBashTail;
}

} // namespace tessera::app
