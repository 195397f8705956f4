#include "apps/Manual.h"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tessera::app {

namespace {

/// Escapes text for roff. Hyphens, quotes and accents must stay literal, since readers copy options from the page.
std::string roff(const std::string& text) {
    std::string escaped = text.starts_with('.') || text.starts_with('\'') ? "\\&" : "";
    for (const char c : text) {
        switch (c) {
        case '\\':
            escaped += "\\e";
            break;
        case '-':
            escaped += "\\-";
            break;
        case '\'':
            escaped += "\\(aq";
            break;
        case '`':
            escaped += "\\(ga";
            break;
        case '^':
            escaped += "\\(ha";
            break;
        case '~':
            escaped += "\\(ti";
            break;
        default:
            escaped += c;
        }
    }
    return escaped;
}

bool isSameText(const OptionText& a, const OptionText& b) {
    return a.names == b.names && a.type == b.type && a.help == b.help && a.group == b.group;
}

/// Every command has --help; the page lists only the program's.
bool isHelp(const OptionText& option) {
    return std::ranges::find(option.names, "--help") != option.names.end();
}

/// Whether several commands have the option, worded alike, under the same named heading.
bool isShared(const ProgramText& text, const OptionText& option) {
    if (option.group == kPlainGroup) return false;
    int commands = 0;
    for (const CommandText& command : text.commands)
        commands +=
            std::ranges::any_of(command.options, [&](const OptionText& other) { return isSameText(option, other); });
    return commands > 1;
}

std::string roffOption(const OptionText& option) {
    std::string names;
    for (const std::string& name : option.names)
        names += fmt::format("{}\\fB{}\\fR", names.empty() ? "" : ", ", roff(name));
    if (option.takesValue()) names += fmt::format(" \\fI{}\\fR", roff(option.type));
    return fmt::format(".TP\n{}\n{}\n", names, roff(option.help));
}

std::string roffOperand(const OptionText& operand) {
    return fmt::format(".TP\n\\fI{}\\fR\n{}\n", roff(operand.type), roff(operand.help));
}

/// Formats a help footer: indented lines as verbatim examples, the rest as paragraphs.
std::string roffFooter(const std::string& footer) {
    std::string text;
    std::istringstream lines(footer);
    bool isExample = false, isParagraph = false;
    for (std::string line; std::getline(lines, line);) {
        const bool isIndented = line.starts_with("  ");
        if (isIndented != isExample) text += isIndented ? ".PP\n.EX\n" : ".EE\n";
        isExample = isIndented;
        if (!isIndented && !line.empty() && !isParagraph) text += ".PP\n";
        isParagraph = !isIndented && !line.empty();
        if (!line.empty()) text += roff(line) + "\n";
    }
    return text + (isExample ? ".EE\n" : "");
}

std::string roffCommand(const ProgramText& text, const CommandText& command) {
    std::string page =
        fmt::format(".SS {}\n{}.\n.PP\n\\fB{}\\fR\n", roff(command.name), roff(command.help), roff(command.usage));
    for (const OptionText& operand : command.operands) page += roffOperand(operand);
    bool hasShared = false;
    for (const OptionText& option : command.options) {
        if (isShared(text, option))
            hasShared = true;
        else if (!isHelp(option))
            page += roffOption(option);
    }
    if (hasShared) page += ".PP\nIt takes the shared options below too.\n";
    return page + roffFooter(command.footer);
}

/// The options shared by several commands, under their headings in --help.
std::string roffSharedOptions(const ProgramText& text) {
    std::vector<OptionText> shared;
    std::vector<std::string> groups;
    for (const CommandText& command : text.commands)
        for (const OptionText& option : command.options) {
            if (!isShared(text, option)) continue;
            if (std::ranges::find(groups, option.group) == groups.end()) groups.push_back(option.group);
            if (std::ranges::none_of(shared, [&](const OptionText& other) { return isSameText(option, other); }))
                shared.push_back(option);
        }
    std::string page;
    for (const std::string& group : groups) {
        page += fmt::format(".SS {}\n", roff(group));
        for (const OptionText& option : shared)
            if (option.group == group) page += roffOption(option);
    }
    return page;
}

} // namespace

std::string manualPage(const ProgramText& text, const std::string& version) {
    std::string page = fmt::format(".\\\" made by tessera manual\n"
                                   ".TH TESSERA 1 \"\" \"tessera {}\" \"User Commands\"\n"
                                   ".SH NAME\ntessera \\- {}\n.SH SYNOPSIS\n\\fB{}\\fR\n",
                                   roff(version), roff(text.program.help), roff(text.program.usage));
    for (const CommandText& command : text.commands) page += fmt::format(".br\n\\fB{}\\fR\n", roff(command.usage));
    page += ".SH COMMANDS\n\\fBtessera help\\fR \\fICOMMAND\\fR shows on the terminal what stands here.\n";
    for (const CommandText& command : text.commands) page += roffCommand(text, command);
    if (const std::string shared = roffSharedOptions(text); !shared.empty()) page += ".SH SHARED OPTIONS\n" + shared;
    page += ".SH OPTIONS OF THE PROGRAM\n";
    for (const OptionText& option : text.program.options) page += roffOption(option);
    return page + ".SH EXAMPLES AND EXIT CODES\n" + roffFooter(text.program.footer);
}

} // namespace tessera::app
