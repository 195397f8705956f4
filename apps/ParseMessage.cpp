#include "apps/ParseMessage.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/Names.h"

namespace tessera::app {

namespace {

const CLI::App* commandNamed(const CLI::App& app, const std::string& name) {
    const std::vector<const CLI::App*> commands = app.get_subcommands({});
    const auto found = std::find_if(commands.begin(), commands.end(),
                                    [&](const CLI::App* command) { return command->check_name(name); });
    return found == commands.end() ? nullptr : *found;
}

const CLI::Option* optionNamed(const CLI::App& app, const std::string& flag) {
    const std::vector<const CLI::Option*> options = app.get_options({});
    const auto found = std::find_if(options.begin(), options.end(),
                                    [&](const CLI::Option* option) { return option->check_name(flag); });
    return found == options.end() ? nullptr : *found;
}

std::string unknownCommand(const CLI::App& app, const std::string& word) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
    const std::vector<std::string_view> candidates(names.begin(), names.end());
    const bool isFile = word.find_first_of("./") != std::string::npos;
    return isFile ? fmt::format("'{0}' is no command; tessera render {0} -o picture.png draws a scene or model, and "
                                "tessera view {0} opens it",
                                word)
                  : fmt::format("unknown command '{}': {}", word, suggestNames(word, candidates));
}

std::string unknownOption(const CLI::App& app, const CLI::App* command, const std::string& flag,
                          const std::string& where) {
    std::vector<std::string> names;
    for (const CLI::App* owner : {&app, command}) {
        if (owner == nullptr) continue;
        for (const CLI::Option* option : owner->get_options({})) {
            for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
        }
    }
    const std::vector<std::string_view> candidates(names.begin(), names.end());
    const std::string suggestion = suggestNames(flag, candidates);
    const bool isNear = suggestion.starts_with("did you mean"); // else it would list them all
    return fmt::format("unknown option '{}'{}", flag, isNear ? ": " + suggestion : where);
}

/// "--environment lacks its value: ..."; empty for other errors.
std::string lackingValue(const CLI::App& app, const CLI::App* command, const CLI::ParseError& error) {
    if (error.get_exit_code() != int(CLI::ExitCodes::ArgumentMismatch)) return {};
    const std::string what = error.what(), flag = what.substr(0, what.find(':'));
    const CLI::Option* option = command ? optionNamed(*command, flag) : nullptr;
    if (option == nullptr) option = optionNamed(app, flag);
    if (option == nullptr || option->get_type_size() == 0 || what.find("missing") == std::string::npos) return {};
    return fmt::format("{0} lacks its value: give it as {0} {1}", flag, option->get_type_name());
}

} // namespace

std::string unknownCommandOf(const CLI::App& app, int argc, const char* const* argv) {
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (!word.starts_with("-")) return commandNamed(app, word) ? "" : unknownCommand(app, word);
        const CLI::Option* option = optionNamed(app, word);
        if (option != nullptr && option->get_type_size() > 0) ++i; // the next word is its value
    }
    return "";
}

std::string parseMessage(const CLI::App& app, const CLI::ParseError& error, int argc, const char* const* argv) {
    const CLI::App* command = nullptr;
    std::string where = "; see tessera --help";
    std::string stray; // an unexpected argument
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "--") break;
        if (word.size() > 1 && word.front() == '-' && word.find_first_of("0123456789.") != 1) {
            const std::string flag = word.substr(0, word.find('='));
            const CLI::Option* option = command ? optionNamed(*command, flag) : nullptr;
            if (option == nullptr) option = optionNamed(app, flag);
            if (option == nullptr) return unknownOption(app, command, flag, where);
            if (option->get_type_size() > 0 && flag == word) ++i; // the next word is its value
        } else if (command == nullptr) {
            command = commandNamed(app, word);
            if (command == nullptr) return unknownCommand(app, word);
            where = fmt::format("; see tessera {} --help", word);
        } else {
            stray = word; // the last one: positional arguments come first
        }
    }
    const std::string who = command ? command->get_name() + ": " : "";
    if (error.get_exit_code() == int(CLI::ExitCodes::ExtrasError))
        return fmt::format("{}unexpected argument '{}'{}", who, stray, where);
    if (const std::string lacking = lackingValue(app, command, error); !lacking.empty()) return who + lacking + where;
    std::string text = error.what();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return who + text + where;
}

} // namespace tessera::app
