#include "apps/CommandText.h"

#include <algorithm>

#include "apps/HelpFormat.h"
#include "apps/OptionValues.h"

namespace tessera::app {

namespace {

OptionText optionText(const std::string& command, const CLI::Option& option) {
    OptionText text;
    for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
    if (option.get_type_size() > 0) text.type = option.get_type_name();
    text.help = option.get_description();
    text.group = option.get_group();
    text.isRepeated =
        option.get_expected_max() > 1 || option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
    text.isRequired = option.get_required();
    if (text.takesValue()) text.value = valuesOf(command, text);
    return text;
}

CommandText commandText(const CLI::App& app, const CLI::App* program) {
    CommandText text;
    if (program) text.name = app.get_name();
    text.help = app.get_description();
    text.usage = usageOf(app, program ? program->get_name() + " " + app.get_name() : app.get_name());
    text.footer = app.get_footer();
    for (const std::string& group : app.get_groups())
        for (const CLI::Option* option : app.get_options({}))
            if (option->get_group() == group && option->nonpositional())
                text.options.push_back(optionText(text.name, *option));
    for (const CLI::Option* option : app.get_options({}))
        if (option->get_positional()) text.operands.push_back(optionText(text.name, *option));
    return text;
}

} // namespace

ProgramText programText(const CLI::App& app) {
    ProgramText text{commandText(app, nullptr), {}};
    for (const CLI::App* command : app.get_subcommands({})) text.commands.push_back(commandText(*command, &app));
    return text;
}

std::vector<OptionText> optionsAfter(const ProgramText& text, const CommandText& command) {
    std::vector<OptionText> options = command.options;
    const auto isNamed = [](const OptionText& option, const char* name) {
        return std::ranges::find(option.names, name) != option.names.end();
    };
    for (const OptionText& option : text.program.options)
        if (!isNamed(option, "--help") && !isNamed(option, "--version")) options.push_back(option);
    return options;
}

} // namespace tessera::app
